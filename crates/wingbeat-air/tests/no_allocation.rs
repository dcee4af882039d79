//! The sums allocate nothing after the first call of a size.

mod wakes;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use wingbeat_air::kernel::{CoreModel, DirectSum, FastSettings, FastSum, Method, Points};

/// The system's allocator, counting.
struct Counting;

thread_local! {
    /// Of this thread alone: the test's harness allocates when it likes.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

#[allow(unsafe_code)]
// SAFETY: hands everything to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn exact_no_allocation_after_warm_up() {
    let model = CoreModel::Vatistas { radius: 0.02 };
    let net = wakes::hover(model, 6_000);
    let mut fast = FastSum::new(FastSettings {
        method: Method::Tree,
        ..FastSettings::new(model)
    });
    let mut direct = DirectSum::new(model);
    let mut v = Points::zeros(net.nodes.len());
    // One thread: what rayon keeps for handing work to others is not ours to count.
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    pool.install(|| {
        let mut step = || {
            fast.load_network(&net);
            fast.add_velocity(&net.nodes, &mut v);
            direct.load_network(&net);
            direct.add_velocity(&net.nodes, &mut v);
        };
        step();
        let before = ALLOCATIONS.get();
        step();
        assert_eq!(ALLOCATIONS.get() - before, 0);
    });
}
