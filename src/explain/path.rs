//! The cheapest paths through a graph without circles, from its first node to its last: of all, through each node and by
//! each edge, from one sum forwards and one backwards.

/// An edge: from, to, cost; always to a later node.
type Edge = (usize, usize, f64);

/// The cheapest paths.
#[derive(Clone, Debug, Default)]
pub struct Paths {
    edges: Vec<Edge>,
    forwards: Vec<f64>,
    backwards: Vec<f64>,
    /// The last edge of the cheapest way to a node, and the first of the cheapest from it.
    behind: Vec<Option<usize>>,
    ahead: Vec<Option<usize>>,
    /// Whether a node is on the cheapest path.
    is_best: Vec<bool>,
}

impl Paths {
    pub fn new(nodes: usize, edges: Vec<Edge>) -> Self {
        let mut paths = Self {
            edges,
            forwards: vec![f64::INFINITY; nodes],
            backwards: vec![f64::INFINITY; nodes],
            behind: vec![None; nodes],
            ahead: vec![None; nodes],
            is_best: vec![false; nodes],
        };
        paths.solve();
        paths
    }

    fn solve(&mut self) {
        let mut order: Vec<usize> = (0..self.edges.len()).collect();
        order.sort_by_key(|edge| self.edges[*edge].0);
        self.forwards[0] = 0.0;
        for &index in &order {
            let (from, to, cost) = self.edges[index];
            let total = self.forwards[from] + cost;
            if total < self.forwards[to] {
                (self.forwards[to], self.behind[to]) = (total, Some(index));
            }
        }
        let end = self.backwards.len() - 1;
        self.backwards[end] = 0.0;
        for &index in order.iter().rev() {
            let (from, to, cost) = self.edges[index];
            let total = self.backwards[to] + cost;
            if total < self.backwards[from] {
                (self.backwards[from], self.ahead[from]) = (total, Some(index));
            }
        }
        self.is_best[0] = true;
        for edge in self.best() {
            self.is_best[self.edges[edge].1] = true;
        }
    }

    /// Of the cheapest path.
    pub fn cost(&self) -> f64 {
        self.backwards[0]
    }

    /// Of the cheapest path through a node.
    pub fn cost_through(&self, node: usize) -> f64 {
        self.forwards[node] + self.backwards[node]
    }

    /// Of the cheapest path by an edge.
    pub fn cost_by(&self, edge: usize) -> f64 {
        let (from, to, cost) = self.edges[edge];
        self.forwards[from] + cost + self.backwards[to]
    }

    /// The edges of the cheapest path.
    pub fn best(&self) -> Vec<usize> {
        self.onwards(0, |_| false).0
    }

    /// Where the cheapest path through a node leaves the cheapest of all and comes back to it: the edges of the cheapest,
    /// and those of the other.
    pub fn detour_through(&self, node: usize) -> (Vec<usize>, Vec<usize>) {
        self.detour(node, None)
    }

    /// The same for the cheapest path by an edge.
    pub fn detour_by(&self, edge: usize) -> (Vec<usize>, Vec<usize>) {
        self.detour(self.edges[edge].0, Some(edge))
    }

    fn detour(&self, node: usize, by: Option<usize>) -> (Vec<usize>, Vec<usize>) {
        let (mut detour, mut from) = (Vec::new(), node);
        while !self.is_best[from] {
            let Some(edge) = self.behind[from] else { break };
            detour.push(edge);
            from = self.edges[edge].0;
        }
        detour.reverse();
        detour.extend(by);
        let after = by.map_or(node, |edge| self.edges[edge].1);
        let (onwards, to) = self.onwards(after, |node| self.is_best[node]);
        detour.extend(onwards);
        (self.onwards(from, |node| node == to).0, detour)
    }

    /// The edges of the cheapest way on from a node, to the first of which `is_last` holds, and that node.
    fn onwards(&self, node: usize, is_last: impl Fn(usize) -> bool) -> (Vec<usize>, usize) {
        let (mut edges, mut place) = (Vec::new(), node);
        while !is_last(place) {
            let Some(edge) = self.ahead[place] else { break };
            edges.push(edge);
            place = self.edges[edge].1;
        }
        (edges, place)
    }
}
