//! Every gate, before every rule: what it may change, and what it may not.

use crate::record::{record, Datum};
use crate::subjects::{rules, subjects, update, Given, Item, Subject};
use forgetting::choice::Kind;
use forgetting::gates::{Answer, AnyGate, GateFunction, GATES};
use forgetting::saved::AnyEstimator;
use forgetting::{
    Constant, Dynamic, Equal, Estimator, Fixed, Kernels, Memory, Noise, Packed, Prior, Real, Size,
    Skip,
};

const SAMPLES: usize = 240;

/// Gates that shut for some samples of the record and open for others.
fn gates() -> Vec<(&'static str, Given)> {
    let mut gates = vec![("open", Given::default())];
    for otherwise in ["hold", "freeze"] {
        let otherwise = ("otherwise", Item::Word(otherwise));
        let information = ("information", Item::Real(0.05));
        gates.push(("minimum_information", Given(vec![information, otherwise.clone()])));
        gates.push(("dead_zone", Given(vec![("width", Item::Real(0.1)), otherwise])));
    }
    gates
}

fn gate<M: Memory>((name, given): &(&'static str, Given), memory: M) -> AnyGate<M> {
    given.with(|values| AnyGate::named(name, values, memory)).unwrap()
}

/// The estimator of `subject` behind `chosen`, for f64.
fn behind(
    subject: &Subject,
    chosen: &(&'static str, Given),
    (n, p, m): (usize, usize, usize),
) -> Option<AnyEstimator<f64>> {
    let memory = Dynamic::new(n, p, m).unwrap();
    let estimator = subject.estimator::<f64>((n, p, m), 0.97, 10.0)?;
    Some(estimator.with_gate(gate(chosen, memory)))
}

#[test]
fn the_gates_tried_are_those_of_the_registry() {
    let tried = gates();
    for about in GATES {
        let by_name = about.parameters.iter().all(|parameter| parameter.kind != Kind::Function);
        assert_eq!(by_name, tried.iter().any(|(name, _)| *name == about.name), "{}", about.name);
    }
}

#[test]
fn a_held_sample_changes_no_bit_and_a_frozen_one_never_forgets() {
    for subject in subjects() {
        for chosen in gates() {
            for sizes in [(3, 1, 1), (3, 2, 2)] {
                let Some(mut estimator) = behind(&subject, &chosen, sizes) else { continue };
                let mut seen = [0; 3];
                for (k, Datum { phi, y, gamma }) in record(sizes, SAMPLES).iter().enumerate() {
                    let before = estimator.to_bytes().unwrap();
                    let noise = [Noise::Unit, Noise::Full(gamma)][k % 2];
                    let told = update(&mut estimator, phi, y, noise).unwrap();
                    seen[usize::from(told.gate.code())] += 1;
                    let held = told.skipped == Some(Skip::Gate);
                    assert_eq!(held, told.gate == Answer::Hold, "{subject:?}, sample {k}");
                    if told.gate != Answer::Update {
                        assert_eq!((told.rank, told.forgetting_factor), (0, 1.0), "{subject:?}");
                    }
                    if held {
                        assert!(estimator.to_bytes().unwrap() == before, "{subject:?}, sample {k}");
                    }
                    assert!(estimator.is_sound(), "{subject:?}, sample {k}");
                }
                let shuts = chosen.0 != "open";
                assert_eq!(seen[1] + seen[2] > 0, shuts, "{subject:?} {chosen:?} {seen:?}");
                assert!(seen[0] > 0, "{subject:?} {chosen:?} {seen:?}");
            }
        }
    }
}

/// R₊ = R + φ̄ᵀφ̄ and θ that of the rule `none`: P before, copied into an estimator that never
/// forgets, becomes the same as in the frozen one.
#[test]
fn a_frozen_sample_is_least_squares() {
    let sizes = (3, 2, 2);
    let none = rules().find(|subject| subject.about.name == "none").unwrap();
    let frozen = |_: &forgetting::Evidence<'_, '_, Dynamic<f64>>| Ok(Answer::Freeze);
    for subject in subjects() {
        let Some(estimator) = subject.estimator::<f64>(sizes, 0.9, 10.0) else { continue };
        let mut frozen = estimator.with_gate(AnyGate::GateFunction(GateFunction::new(frozen)));
        let mut plain = none.estimator::<f64>(sizes, 0.9, 10.0).unwrap();
        for Datum { phi, y, gamma } in &record(sizes, SAMPLES) {
            update(&mut frozen, phi, y, Noise::Full(gamma)).unwrap();
            update(&mut plain, phi, y, Noise::Full(gamma)).unwrap();
        }
        assert_eq!(frozen.theta(), plain.theta(), "{subject:?}");
        let diagonal = plain.factor().diagonal_elements();
        assert_eq!(frozen.factor().diagonal_elements(), diagonal, "{subject:?}");
    }
}

/// Rules whose state follows P: after frozen samples they go on as a new estimator that starts
/// from the same P and θ.
#[test]
fn what_a_rule_keeps_of_p_follows_frozen_samples() {
    /// largest relative difference of the variances: measured 1.1e-15
    const TOLERANCE: f64 = 1e-13;
    let sizes = (4, 2, 1);
    let early = |evidence: &forgetting::Evidence<'_, '_, Dynamic<f64>>| {
        let frozen = (20..30).contains(&evidence.samples);
        Ok(if frozen { Answer::Freeze } else { Answer::Update })
    };
    let data = record::<f64>(sizes, SAMPLES);
    for name in ["variable_direction", "matrix_forgetting", "multiple"] {
        let mut subject = rules().find(|subject| subject.about.name == name).unwrap();
        if name == "matrix_forgetting" {
            subject.given.0.push(("power", Item::Real(3.0)));
        }
        let estimator = subject.estimator::<f64>(sizes, 0.9, 10.0).unwrap();
        let mut whole = estimator.with_gate(AnyGate::GateFunction(GateFunction::new(early)));
        for Datum { phi, y, .. } in &data[..30] {
            update(&mut whole, phi, y, Noise::Unit).unwrap();
        }
        let mut covariance = [0.0; 16];
        whole.factor().reconstruct(&mut covariance);
        let memory = Dynamic::new(4, 2, 1).unwrap();
        let prior = Prior::dense(memory, &covariance).unwrap().with_theta(whole.theta()).unwrap();
        let rate = Constant::new(0.9).unwrap();
        let mut new = Estimator::new(subject.rule(memory).unwrap(), rate, Equal::new(), prior);
        for Datum { phi, y, .. } in &data[30..45] {
            update(&mut whole, phi, y, Noise::Unit).unwrap();
            update(&mut new, phi, y, Noise::Unit).unwrap();
            let (mut a, mut b) = ([0.0; 4], [0.0; 4]);
            whole.factor().variances(&mut a);
            new.factor().variances(&mut b);
            for (a, b) in a.iter().zip(&b) {
                assert!((a - b).abs() <= TOLERANCE * b, "{name}: {a} {b}");
            }
        }
    }
}

#[test]
fn a_gate_that_always_lets_through_is_no_gate() {
    let sizes = (3, 2, 2);
    let open = |_: &forgetting::Evidence<'_, '_, Dynamic<f64>>| Ok(Answer::Update);
    for subject in subjects() {
        let Some(mut plain) = subject.estimator::<f64>(sizes, 0.97, 10.0) else { continue };
        let mut gated = plain.clone().with_gate(AnyGate::GateFunction(GateFunction::new(open)));
        for Datum { phi, y, gamma } in &record(sizes, SAMPLES) {
            let told = update(&mut gated, phi, y, Noise::Full(gamma)).unwrap();
            let other = update(&mut plain, phi, y, Noise::Full(gamma)).unwrap();
            assert_eq!(told.leverage.to_bits(), other.leverage.to_bits(), "{subject:?}");
        }
        assert_eq!(gated.theta(), plain.theta(), "{subject:?}");
    }
}

/// Everything that an estimator tells, bit for bit.
fn trace<M: Memory>(
    subject: &Subject,
    memory: M,
    chosen: &(&'static str, Given),
    data: &[Datum<M::Real>],
) -> Vec<u64> {
    let rate = Constant::new(M::Real::from_f64(0.97)).unwrap();
    let prior = Prior::scalar(memory, M::Real::from_f64(10.0)).unwrap();
    let mut estimator = Estimator::new(subject.rule(memory).unwrap(), rate, Equal::new(), prior)
        .with_gate(gate(chosen, memory));
    let mut told = Vec::new();
    for Datum { phi, y, gamma } in data {
        let outcome = update(&mut estimator, phi, y, Noise::Full(gamma)).unwrap();
        told.push(outcome.leverage.to_bits());
        told.push(outcome.gate.code().into());
        told.extend(estimator.theta().iter().map(|x| x.to_f64().to_bits()));
    }
    told
}

fn same_bits<T: Kernels, const N: usize, const P: usize, const M: usize>()
where
    Size<N>: Packed<T>,
{
    let (stack, heap) = (Fixed::<T, N, P, M>::new(), Dynamic::<T>::new(N, P, M).unwrap());
    let data = record::<T>((N, P, M), SAMPLES);
    for subject in rules() {
        if subject.about.largest_rows.is_some_and(|rows| rows < P) {
            continue;
        }
        for chosen in gates() {
            let (stack, heap) =
                (trace(&subject, stack, &chosen, &data), trace(&subject, heap, &chosen, &data));
            assert!(stack == heap, "{subject:?} behind {chosen:?}");
        }
    }
}

#[test]
fn fixed_and_dynamic_sizes_give_the_same_bits() {
    same_bits::<f64, 3, 1, 1>();
    same_bits::<f64, 4, 2, 2>();
    same_bits::<f32, 3, 1, 1>();
}

#[test]
fn a_save_in_the_middle_changes_no_bit() {
    let sizes = (3, 1, 1);
    let data = record::<f64>(sizes, SAMPLES);
    for subject in rules() {
        for chosen in gates() {
            let mut whole = behind(&subject, &chosen, sizes).unwrap();
            let mut broken = whole.clone();
            for piece in data.chunks(50) {
                for Datum { phi, y, .. } in piece {
                    update(&mut whole, phi, y, Noise::Unit).unwrap();
                    update(&mut broken, phi, y, Noise::Unit).unwrap();
                }
                let bytes = broken.to_bytes().unwrap();
                broken = AnyEstimator::from_bytes(&bytes).unwrap();
                assert_eq!(broken.gate().about().name, chosen.0);
                assert!(broken.to_bytes().unwrap() == whole.to_bytes().unwrap(), "{subject:?}");
            }
        }
    }
}

#[test]
fn a_refused_sample_changes_no_bit() {
    for chosen in gates() {
        let subject = rules().find(|subject| subject.about.name == "subspace").unwrap();
        let mut estimator = behind(&subject, &chosen, (2, 1, 1)).unwrap();
        update(&mut estimator, &[1.0, 2.0], &[3.0], Noise::Unit).unwrap();
        let before = estimator.to_bytes().unwrap();
        for (phi, y, noise) in [
            ([f64::NAN, 1.0], 1.0, Noise::Unit),
            ([1.0, 1e200], 1.0, Noise::Unit),
            ([1.0, 1.0], f64::INFINITY, Noise::Unit),
            ([1.0, 1.0], 1.0, Noise::Scalar(-1.0)),
        ] {
            update(&mut estimator, &phi, &[y], noise).unwrap_err();
            assert!(estimator.to_bytes().unwrap() == before, "{chosen:?}");
        }
    }
}

#[test]
fn parameters_are_checked() {
    let memory = Dynamic::<f64>::new(2, 1, 1).unwrap();
    for about in GATES {
        for parameter in about.parameters {
            let bad = match parameter.kind {
                Kind::Word(_) => Item::Word("no such word"),
                _ => Item::Real(-1.0),
            };
            let given = Given::one(parameter.name, bad);
            let error =
                given.with(|values| AnyGate::named(about.name, values, memory)).unwrap_err();
            assert!(error.to_string().contains(parameter.name), "{error}");
        }
    }
    let unknown = Given::default().with(|values| AnyGate::named("none such", values, memory));
    assert_eq!(unknown.unwrap_err(), forgetting::Error::Unknown { parameter: "gate" });
}
