//! All explanations of a record's pulses as paths through a lattice, and the cheapest of them.
//!
//! Between pulses the cage rests or moves. A node is a rest between two pulses, or a motion up or down at the edge
//! of a hole; the beginning and the end of the record are holes. An edge is a trip from rest to rest, a motion from
//! or to a hole, or pulses that are something else. Costs add along a path, so the cheapest explanation, and the
//! cheapest with the cage at rest or in motion at any time, follow from one sum forwards and one backwards.

use super::cost::{self, Prior};
use super::path::Paths;
use super::pulse::Pulse;
use super::stretch::Stretch;
use super::trips::{Motion, Motions};
use std::ops::Range;

/// An edge dearer than the usual explanation by this much cannot matter.
const HOPELESS: f64 = 12.0;

/// A hole shorter than this can hardly hide a start, s.
const SHORT_HOLE: f64 = 1.0;

/// What an edge says of its pulses.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// They are no motion of the cage.
    Other(Range<usize>),
    /// They are a motion, which may be open at either end.
    Motion(Motion),
    /// The cage moves past all of them.
    Through(Range<usize>),
    /// A hole: whether the motion goes on across it.
    Hole {
        /// Whether it moves on both sides.
        moves_on: bool,
    },
}

#[derive(Clone, Debug)]
struct Edge {
    from: usize,
    to: usize,
    cost: f64,
    part: Part,
}

/// A stretch between holes.
#[derive(Clone, Debug)]
struct Section {
    pulses: Range<usize>,
    /// The node of motion up that enters it; the next is motion down, then the rests, then two nodes of exit.
    first_node: usize,
}

impl Section {
    fn entry(&self, is_up: bool) -> usize {
        self.first_node + usize::from(!is_up)
    }

    fn rest(&self, gap: usize) -> usize {
        self.first_node + 2 + gap
    }

    fn exit(&self, is_up: bool) -> usize {
        self.rest(self.pulses.len()) + 1 + usize::from(!is_up)
    }
}

/// The explanations of pulses.
#[derive(Clone, Debug)]
pub struct Lattice {
    edges: Vec<Edge>,
    sections: Vec<Section>,
    nodes: usize,
    paths: Paths,
    /// The cheapest path with motion in a gap: its cost and edge.
    moving: Vec<(f64, Option<usize>)>,
}

impl Lattice {
    /// `stretches` without holes: how many pulses there are up to the end of each, its beginning and its end, s.
    pub fn new(prior: &Prior, pulses: &[Pulse], stretches: &[(usize, f64, f64)]) -> Self {
        let mut sections: Vec<Section> = Vec::new();
        let mut next = (0, 1);
        for &(end, ..) in stretches {
            let pulses = next.0..end;
            let first_node = next.1;
            next = (end, first_node + pulses.len() + 5);
            sections.push(Section { pulses, first_node });
        }
        let mut lattice = Self {
            edges: Vec::new(),
            nodes: next.1 + 1,
            paths: Paths::default(),
            moving: vec![(f64::INFINITY, None); pulses.len() + sections.len()],
            sections,
        };
        for (index, &(_, begin, end)) in stretches.iter().enumerate() {
            let section = lattice.sections[index].clone();
            let stretch = Stretch::new(prior, &pulses[section.pulses.clone()], (begin, end));
            lattice.explain(&section, stretch);
        }
        let holes = stretches.windows(2).map(|pair| pair[1].1 - pair[0].2);
        lattice.join(prior, &holes.collect::<Vec<_>>());
        lattice.solve();
        lattice
    }

    fn edge(&mut self, from: usize, to: usize, cost: f64, part: Part) {
        self.edges.push(Edge {
            from,
            to,
            cost,
            part,
        });
    }

    /// The edges within a stretch.
    fn explain(&mut self, section: &Section, stretch: Stretch) {
        let offset = section.pulses.start;
        let shift = |range: Range<usize>| range.start + offset..range.end + offset;
        for pulse in 0..section.pulses.len() {
            let ignored = stretch.ignored(pulse);
            let (from, to) = (section.rest(pulse), section.rest(pulse + 1));
            self.edge(from, to, ignored, Part::Other(shift(pulse..pulse + 1)));
            for (after, cost) in stretch.disturbances(pulse) {
                self.edge(
                    from,
                    section.rest(after),
                    cost,
                    Part::Other(shift(pulse..after)),
                );
            }
        }
        let past: f64 = (0..section.pulses.len())
            .map(|pulse| stretch.ignored(pulse))
            .sum();
        let reversed = Motions::new(stretch.reversed());
        let forwards = Motions::new(stretch);
        let mut add = |motion: Motion, is_open: bool, is_reversed: bool| {
            let pulses = motion.pulses.clone();
            let motions = if is_reversed { &reversed } else { &forwards };
            if motions.excess(pulses.clone(), motion.cost) > HOPELESS {
                return;
            }
            let is_up = motion.top > 0.0;
            let (from, to) = match (is_open, is_reversed) {
                (false, _) => (section.rest(pulses.start), section.rest(pulses.end)),
                (true, false) => (section.rest(pulses.start), section.exit(is_up)),
                (true, true) => (section.entry(is_up), section.rest(pulses.end)),
            };
            let part = Motion {
                pulses: shift(pulses),
                changes: motion.changes.iter().map(|pulse| pulse + offset).collect(),
                is_open: (is_open && is_reversed, is_open && !is_reversed),
                ..motion
            };
            self.edge(from, to, part.cost, Part::Motion(part));
        };
        for first in 0..section.pulses.len() {
            forwards.of(first, &mut |motion, is_open| add(motion, is_open, false));
            reversed.of(first, &mut |motion, is_open| {
                if is_open {
                    add(motion, true, true);
                }
            });
        }
        for is_up in [true, false] {
            let part = Part::Through(section.pulses.clone());
            self.edge(section.entry(is_up), section.exit(is_up), past, part);
        }
    }

    /// The edges across holes, and at the ends of the record.
    fn join(&mut self, prior: &Prior, holes: &[f64]) {
        let (first, last) = (
            self.sections[0].clone(),
            self.sections[self.sections.len() - 1].clone(),
        );
        let end = self.nodes - 1;
        let rest = |is_known: Option<bool>| {
            if is_known == Some(false) {
                cost::ABSURD
            } else {
                0.0
            }
        };
        let motion = match prior.begins_at_rest {
            Some(true) => cost::ABSURD,
            Some(false) => 0.0,
            None => cost::OPEN,
        };
        let stand = Part::Hole { moves_on: false };
        self.edge(0, first.rest(0), rest(prior.begins_at_rest), stand.clone());
        self.edge(last.rest(last.pulses.len()), end, 0.0, stand.clone());
        for is_up in [true, false] {
            self.edge(0, first.entry(is_up), motion, stand.clone());
            self.edge(last.exit(is_up), end, cost::OPEN, stand.clone());
        }
        for (index, &seconds) in holes.iter().enumerate() {
            let (before, after) = (
                self.sections[index].clone(),
                self.sections[index + 1].clone(),
            );
            let change = if seconds < SHORT_HOLE {
                2.0 * cost::IN_HOLE
            } else {
                cost::IN_HOLE
            };
            let stands = before.rest(before.pulses.len());
            self.edge(stands, after.rest(0), 0.0, stand.clone());
            for is_up in [true, false] {
                let moves_on = Part::Hole { moves_on: true };
                self.edge(
                    before.exit(is_up),
                    after.entry(is_up),
                    cost::ACROSS_HOLE,
                    moves_on,
                );
                self.edge(
                    before.exit(is_up),
                    after.entry(!is_up),
                    2.0 * change,
                    stand.clone(),
                );
                self.edge(stands, after.entry(is_up), change, stand.clone());
                self.edge(before.exit(is_up), after.rest(0), change, stand.clone());
            }
        }
    }

    fn solve(&mut self) {
        let ways = self
            .edges
            .iter()
            .map(|edge| (edge.from, edge.to, edge.cost));
        self.paths = Paths::new(self.nodes, ways.collect());
        for index in 0..self.edges.len() {
            let total = self.paths.cost_by(index);
            for gap in self.gaps_in_motion(&self.edges[index]) {
                if total < self.moving[gap].0 {
                    self.moving[gap] = (total, Some(index));
                }
            }
        }
    }

    /// The gaps in which the cage moves along an edge.
    fn gaps_in_motion(&self, edge: &Edge) -> Range<usize> {
        let (Part::Motion(Motion { pulses, .. }) | Part::Through(pulses)) = &edge.part else {
            return 0..0;
        };
        let section = self
            .sections
            .partition_point(|section| section.first_node <= edge.from)
            - 1;
        let it = &self.sections[section];
        let is_open = (edge.from < it.rest(0), edge.to > it.rest(it.pulses.len()));
        let first = pulses.start + section + usize::from(!is_open.0);
        first..pulses.end + section + usize::from(is_open.1)
    }

    /// The cost of the cheapest explanation.
    pub fn cost(&self) -> f64 {
        self.paths.cost()
    }

    /// How much dearer than the cheapest explanation the cheapest is with the cage at rest, and with it moving, in
    /// each gap between pulses. A hole parts a gap in two.
    pub fn margins(&self) -> Vec<(f64, f64)> {
        let rests = self
            .sections
            .iter()
            .flat_map(|section| (0..=section.pulses.len()).map(|gap| section.rest(gap)));
        rests
            .zip(&self.moving)
            .map(|(node, moving)| {
                let rest = self.paths.cost_through(node);
                (rest - self.cost(), moving.0 - self.cost())
            })
            .collect()
    }

    /// The parts of the cheapest explanation.
    pub fn best(&self) -> Vec<&Part> {
        self.parts(&self.paths.best())
    }

    /// Where the cheapest explanation with the cage at rest in this gap, or with it moving, leaves the cheapest of all
    /// and comes back to it: the parts of the cheapest, and those of the other.
    pub fn detour(&self, gap: usize, moves: bool) -> (Vec<&Part>, Vec<&Part>) {
        let (best, other) = match self.moving[gap].1 {
            Some(edge) if moves => self.paths.detour_by(edge),
            None if moves => return (Vec::new(), Vec::new()),
            _ => self.paths.detour_through(self.rest(gap)),
        };
        (self.parts(&best), self.parts(&other))
    }

    /// The node of rest in a gap.
    fn rest(&self, gap: usize) -> usize {
        let before = |index: usize| self.sections[index].pulses.start + index;
        let count = self.sections.len();
        let indices: Vec<usize> = (0..count).collect();
        let section = indices.partition_point(|index| before(*index) <= gap) - 1;
        self.sections[section].rest(gap - before(section))
    }

    fn parts(&self, edges: &[usize]) -> Vec<&Part> {
        edges.iter().map(|edge| &self.edges[*edge].part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// All paths from a node to the end, with their costs and the gaps in which they rest or move.
    fn paths(lattice: &Lattice, node: usize) -> Vec<(f64, Vec<usize>)> {
        if node == lattice.nodes - 1 {
            return vec![(0.0, Vec::new())];
        }
        let edges = (0..lattice.edges.len()).filter(|edge| lattice.edges[*edge].from == node);
        let longer = edges.flat_map(|index| {
            let edge = &lattice.edges[index];
            paths(lattice, edge.to)
                .into_iter()
                .map(move |(cost, mut by)| {
                    by.push(index);
                    (cost + edge.cost, by)
                })
        });
        longer.collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        /// The cheapest path, and the cheapest with motion in each gap, are those of all paths.
        #[test]
        fn margins_are_those_of_all_paths(changes in prop::collection::vec(
            prop::sample::select(vec![-1.0, -0.5, 0.1, 0.5, 1.0]), 1..5,
        )) {
            let pulse = |(index, change): (usize, f64)| Pulse {
                blocks: 0..1,
                from: 10.0 * index as f64 + 5.0,
                to: 10.0 * index as f64 + 6.5,
                change,
                deviation: 0.01,
                is_violent: false,
                is_swing: false,
            };
            let pulses: Vec<Pulse> = changes.into_iter().enumerate().map(pulse).collect();
            let middle = pulses.len() / 2;
            let ends = [(middle, 0.0, 10.0 * middle as f64), (pulses.len(), 10.0 * middle as f64 + 2.0, 60.0)];
            let lattice = Lattice::new(&Prior::default(), &pulses, &ends);
            let all = paths(&lattice, 0);
            let best = all.iter().map(|path| path.0).fold(f64::INFINITY, f64::min);
            prop_assert!((lattice.cost() - best).abs() < 1e-9);
            for (gap, (_, motion)) in lattice.margins().into_iter().enumerate() {
                let moves = |path: &&(f64, Vec<usize>)| {
                    path.1.iter().any(|edge| lattice.gaps_in_motion(&lattice.edges[*edge]).contains(&gap))
                };
                let expected = all.iter().filter(moves).map(|path| path.0).fold(f64::INFINITY, f64::min);
                prop_assert!((best + motion - expected).abs() < 1e-9 || motion == expected, "{}", gap);
            }
        }
    }
}
