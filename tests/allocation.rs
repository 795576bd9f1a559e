//! No allocation inside a trial: a block of many trials allocates as often as a block of one. A monitor holds
//! as much memory after a day as after a minute.

use liftsim::chain::{Observation, Trial};
use liftsim::experiment::SweepConfig;
use liftsim::monitor::{Knowledge, Monitor, Settings};
use liftsim::pilot::Pilots;
use liftsim::plan::Plan;
use liftsim::recording::Sample;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    // Counted per thread, because the test harness allocates in its own threads.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
    static HELD: Cell<i64> = const { Cell::new(0) };
}

/// Bytes allocated and not freed by this thread.
fn held() -> i64 {
    HELD.with(Cell::get)
}

fn allocations() -> u64 {
    ALLOCATIONS.with(Cell::get)
}

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // A thread that is ending is not counted any more.
        let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
        let _ = HELD.try_with(|bytes| bytes.set(bytes.get() + layout.size() as i64));
        // SAFETY: the caller keeps `alloc`'s contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        let _ = HELD.try_with(|bytes| bytes.set(bytes.get() - layout.size() as i64));
        // SAFETY: the caller keeps `dealloc`'s contract.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

const EVERYTHING: &str = r#"
question = "Does any path of a trial allocate?"
seed = 1
pilot = 2000
[axis]
delta = [0.0, 1.0]
[[curve]]
[[curve]]
whitening = { fit = "burg", order = 4 }
[[curve]]
whitening = { fit = "yule-walker", order = 4 }
[[curve]]
whitening = { order = "auto" }
[[curve]]
whitening = { fit = "burg", order = "auto" }
[[curve]]
noise = { law = { student_t = 3.0 }, quantum = 1.0, range = 8.0 }
samples = { gap = 2, decimation = 3 }
[[curve]]
rest = { drift = 0.01, swell = 2.0, footfalls = 0.1 }
detector = { ties = "strict" }
[[curve]]
detector = { rule = "clairvoyant", calibrate = {} }
[[curve]]
detector = { rule = "block-means", calibrate = {} }
[[curve]]
detector = { rule = "student-t", calibrate = {} }
[[curve]]
detector = { rule = "variance-ratio", calibrate = {} }
[[curve]]
noise = { law = { contaminated = { share = 0.1, scale = 5.0 } } }
motion = { profile = { trapezoid = { rise = 3.0 } } }
"#;

#[test]
fn trials_do_not_allocate() {
    let config = SweepConfig::parse("everything", EVERYTHING).unwrap();
    let plan = Plan::new(&config).unwrap();
    let mut counts = vec![0; plan.points.len()];
    let pilots = Pilots::new(&plan.points, plan.pilot, plan.seed).unwrap();
    let decisions = pilots.decide(|_| {}).unwrap();
    for family in &plan.schedule.families {
        let mut allocations_of = |trials| {
            let before = allocations();
            let mut trial = Trial::new(family);
            for index in 0..trials {
                trial.run(index, &mut |place: usize, observation: &mut Observation| {
                    counts[place] += u64::from(decisions[place].is_h1(observation));
                });
            }
            allocations() - before
        };
        assert_eq!(allocations_of(1), allocations_of(500));
    }
}

/// A minute of rests and rides, repeated, with learning from each rest.
#[test]
fn a_monitor_does_not_grow() {
    let acceleration = |i: u32| match i % 6000 {
        2000..2200 | 4200..4400 => 0.5,
        3200..3400 | 5400..5600 => -0.5,
        _ => 0.0,
    };
    // The noise differs from minute to minute.
    let noise = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 16) * 3e-7;
    let knowledge = Knowledge {
        begins_at_rest: true,
        ..Knowledge::default()
    };
    let mut monitor = Monitor::new(Settings::default().at(100.0).unwrap(), knowledge);
    let (mut events, mut held_at) = (0, Vec::new());
    for i in 0..2_000_000 {
        let sample = Sample {
            time: f64::from(i) / 100.0,
            acceleration: acceleration(i) + noise(i),
        };
        events += monitor.step(sample, None).len();
        if i == 30_000 || i == 1_999_999 {
            held_at.push(held());
        }
    }
    println!("{events} events, {held_at:?} bytes held after 5 minutes and after 5.5 hours");
    assert!(events > 2000);
    // The filter's order may differ from rest to rest, and so may the blocks that are ranked: 768 of 8 bytes at most.
    assert!(
        (held_at[1] - held_at[0]).abs() < 1024 + 8 * 768,
        "{held_at:?}"
    );
}
