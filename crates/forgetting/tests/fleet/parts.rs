//! Updates part by part, which allocate nothing.

use super::given::{fleet, given, Given, COUNT};
use forgetting::fleet::{Outputs, Samples};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call is the system allocator's; counting changes nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn parts_are_the_whole_and_an_update_allocates_nothing() {
    for n in [4, 10] {
        let mut whole = fleet::<f64>("subspace", n, 0.9);
        let mut parted = whole.clone();
        assert!(parted.parts(3).unwrap().count() > 1);
        let given: Vec<_> = (0..20).map(|step| given::<f64>(step, n)).collect();
        let none = || Outputs { error: None, leverage: None, skipped: None };
        for Given { phi, y, mask } in &given {
            let samples = Samples { phi, y, mask: Some(mask) };
            whole.update(samples, none()).unwrap();
        }
        let before = ALLOCATIONS.with(Cell::get);
        for Given { phi, y, mask } in &given {
            let (mut rest, mut told) = (Samples { phi, y, mask: Some(mask) }, none());
            for mut part in parted.parts(3).unwrap() {
                let (own, others) = rest.split_at(part.count(), n);
                let (mut own_told, others_told) = told.split_at(part.count());
                (rest, told) = (others, others_told);
                part.update(own, &mut own_told);
            }
        }
        assert_eq!(ALLOCATIONS.with(Cell::get) - before, 0);
        for i in 0..COUNT {
            assert_eq!(whole.get(i).to_bytes(), parted.get(i).to_bytes());
        }
    }
}
