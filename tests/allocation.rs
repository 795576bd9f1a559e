//! No allocation inside a trial: a block of many trials allocates as often as a block of one.

use liftsim::chain::{Observation, Trial};
use liftsim::config::Config;
use liftsim::pilot::Pilots;
use liftsim::plan::Plan;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    // Of this thread alone: the test harness allocates on its own when it likes.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

fn allocations() -> u64 {
    ALLOCATIONS.with(Cell::get)
}

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // A thread that is ending counts no more.
        let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
        // SAFETY: the caller keeps `alloc`'s contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
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
    let config = Config::parse("everything", EVERYTHING).unwrap();
    let plan = Plan::new(&config).unwrap();
    let mut counts = vec![0; plan.points.len()];
    let decisions = Pilots::new(&plan).unwrap().decide(|_| {}).unwrap();
    for family in &plan.ensemble.families {
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
