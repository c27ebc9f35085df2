//! What a fleet refuses.

use super::given::{estimator, fleet, COUNT};
use forgetting::fleet::{Fleet, Outputs, Samples};
use forgetting::Error;

#[test]
fn what_does_not_fit_is_refused_and_changes_nothing() {
    let mut fleet = fleet::<f64>("subspace", 2, 0.9);
    let before = fleet.get(0).to_bytes().unwrap();
    let (phi, y) = ([1.0; 2 * COUNT], [1.0; COUNT]);
    let told = || Outputs { error: None, leverage: None, skipped: None };
    let bad = [
        Samples { phi: &phi[1..], y: &y, mask: None },
        Samples { phi: &phi, y: &y[1..], mask: None },
        Samples { phi: &phi, y: &y, mask: Some(&[true]) },
    ];
    for samples in bad {
        assert!(matches!(fleet.update(samples, told()), Err(Error::Length { .. })));
    }
    let short = Outputs { error: Some(&mut [0.0]), leverage: None, skipped: None };
    let samples = Samples { phi: &phi, y: &y, mask: None };
    assert!(matches!(fleet.update(samples, short), Err(Error::Length { .. })));
    assert!(matches!(fleet.put(0, estimator("none", 2, 0.9)), Err(Error::Unsupported { .. })));
    assert!(matches!(fleet.grow(usize::MAX / 4), Err(Error::Memory)));
    let reset = estimator::<f64>("constant_trace", 2, 0.9);
    assert!(matches!(Fleet::of(reset), Err(Error::Unsupported { .. })));
    assert_eq!(fleet.get(0).to_bytes().unwrap(), before);
    assert_eq!(fleet.count(), COUNT);
}
