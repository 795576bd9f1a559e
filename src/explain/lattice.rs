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
use rayon::prelude::*;
use std::ops::Range;

/// So few pulses are not worth another thread.
const FEW: usize = 64;

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

/// A way to another explanation.
#[derive(Clone, Copy, Debug)]
pub enum Other {
    /// By an edge.
    By(usize),
    /// Through a node.
    Through(usize),
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
    /// The edges across each hole.
    holes: Vec<Range<usize>>,
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
            holes: Vec::new(),
            nodes: next.1 + 1,
            paths: Paths::default(),
            moving: vec![(f64::INFINITY, None); pulses.len() + sections.len()],
            sections,
        };
        for (index, &(_, begin, end)) in stretches.iter().enumerate() {
            let section = lattice.sections[index].clone();
            let stretch = Stretch::new(prior, &pulses[section.pulses.clone()], (begin, end));
            let ends = (index == 0, index + 1 == stretches.len());
            lattice.explain(&section, stretch, ends);
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

    /// The edges within a stretch, with which the record begins or ends or not.
    fn explain(&mut self, section: &Section, stretch: Stretch, (begins, ends): (bool, bool)) {
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
            .map(|pulse| stretch.passed(pulse))
            .sum();
        let reversed = stretch.reversed();
        let (forwards, reversed) = rayon::join(
            || Motions::new(stretch, begins),
            || Motions::new(reversed, ends),
        );
        let add = |(motion, is_open, is_reversed): (Motion, bool, bool)| {
            let pulses = motion.pulses.clone();
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
        let motions = (0..section.pulses.len()).into_par_iter().map(|first| {
            let mut found = Vec::new();
            forwards.of(first, &mut |motion, is_open| {
                found.push((motion, is_open, false));
            });
            if reversed.reach_the_end(first) {
                reversed.of(first, &mut |motion, is_open| {
                    if is_open {
                        found.push((motion, true, true));
                    }
                });
            }
            found
        });
        let motions: Vec<_> = motions.with_min_len(FEW).collect();
        motions.into_iter().flatten().for_each(add);
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
            let before = self.sections[index].clone();
            let after = self.sections[index + 1].clone();
            let stands = before.rest(before.pulses.len());
            let change = cost::in_hole(seconds);
            let first_edge = self.edges.len();
            self.edge(stands, after.rest(0), 0.0, stand.clone());
            for is_up in [true, false] {
                let (out, into) = (before.exit(is_up), after.entry(is_up));
                let moves_on = Part::Hole { moves_on: true };
                self.edge(out, into, prior.across_hole(seconds), moves_on);
                for into in [into, after.entry(!is_up)] {
                    self.edge(out, into, cost::stopover(seconds), stand.clone());
                }
                self.edge(stands, into, change, stand.clone());
                self.edge(out, after.rest(0), change, stand.clone());
            }
            self.holes.push(first_edge..self.edges.len());
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

    /// The least that the record of a lift may cost that speeds up in stages, of the motions that are plausible otherwise:
    /// a late stage, and creeping before it, cost it hardly anything.
    pub fn cost_in_stages(&self, pulses: &[Pulse]) -> f64 {
        let ways = self.edges.iter().map(|edge| {
            let stages = match &edge.part {
                Part::Motion(motion) => motion.late_stages(pulses) as f64,
                _ => 0.0,
            };
            let saved = stages * (cost::LATE_STAGE + cost::MOST_CREEP);
            (edge.from, edge.to, (edge.cost - saved).max(0.0))
        });
        Paths::new(self.nodes, ways.collect()).cost()
    }

    /// The cost of the cheapest explanation.
    pub fn cost(&self) -> f64 {
        self.paths.cost()
    }

    /// How much dearer than the cheapest explanation the cheapest is with the cage at rest, and with it moving, in
    /// each gap between pulses. A hole parts a gap in two.
    fn margins(&self) -> Vec<(f64, f64)> {
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

    /// How much dearer than the cheapest explanation the cheapest other one is at each gap, where the cage moves instead
    /// of resting or rests instead of moving, and at each hole, where it stops instead of going on or goes on; with
    /// the way to it.
    pub fn others(&self) -> impl Iterator<Item = (f64, Other)> + '_ {
        let gaps = self.margins().into_iter().enumerate();
        let gaps = gaps.map(|(gap, (rest, motion))| {
            if rest >= motion {
                (rest, Other::Through(self.rest(gap)))
            } else {
                let edge = self.moving[gap].1;
                (
                    motion,
                    edge.map_or(Other::Through(self.rest(gap)), Other::By),
                )
            }
        });
        let holes = self.holes.iter().flat_map(|edges| {
            [true, false].map(|goes_on| {
                let of_kind = edges
                    .clone()
                    .filter(|edge| self.edges[*edge].part == Part::Hole { moves_on: goes_on });
                let costs = of_kind.map(|edge| (self.paths.cost_by(edge), edge));
                let cheapest = costs.min_by(|a, b| a.0.total_cmp(&b.0));
                cheapest.map(|(cost, edge)| (cost - self.cost(), Other::By(edge)))
            })
        });
        gaps.chain(holes.flatten())
    }

    /// Where another explanation leaves the cheapest of all and comes back to it: the parts of the cheapest, and those
    /// of the other, from rest to rest.
    pub fn detour(&self, other: Other) -> (Vec<&Part>, Vec<&Part>) {
        let (best, other) = match other {
            Other::By(edge) => self.paths.detour_by(edge),
            Other::Through(node) => self.paths.detour_through(node),
        };
        let Some(&first) = best.first() else {
            return (Vec::new(), Vec::new());
        };
        let path = self.paths.best();
        let from = self.edges[first].from;
        let start = path.partition_point(|edge| self.edges[*edge].from < from);
        let end = start + best.len();
        let before = path[..start].iter().rev();
        let before = before
            .scan(from, |node, edge| {
                let is_needed = !self.is_rest(*node);
                *node = self.edges[*edge].from;
                is_needed.then_some(())
            })
            .count();
        let to = self.edges[path[end - 1]].to;
        let after = path[end..].iter();
        let after = after
            .scan(to, |node, edge| {
                let is_needed = !self.is_rest(*node);
                *node = self.edges[*edge].to;
                is_needed.then_some(())
            })
            .count();
        let whole = |part: &[usize]| {
            self.parts(&[&path[start - before..start], part, &path[end..end + after]].concat())
        };
        (whole(&best), whole(&other))
    }

    /// Whether the cage rests at a node.
    fn is_rest(&self, node: usize) -> bool {
        let after = self
            .sections
            .partition_point(|section| section.first_node <= node);
        after > 0 && node < self.nodes - 1 && {
            let it = &self.sections[after - 1];
            (it.rest(0)..=it.rest(it.pulses.len())).contains(&node)
        }
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
                shift: 0.0,
                is_level: false,
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
