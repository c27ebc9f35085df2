//! Bytes that no estimator saved, with a right check: refused or read, at no cost beyond their
//! length, and what is read goes on soundly.

use crate::states::all_subjects;
use crate::subjects::update;
use crate::target::fuzz;
use forgetting::saved::AnyEstimator;
use forgetting::Noise;
use proptest::prelude::*;
use proptest::sample::Index;

/// A change of a saved state.
#[derive(Clone, Debug)]
enum Change {
    /// this byte at this place
    Byte(Index, u8),
    /// this number, of as many bytes, at this place
    Number(Index, f64),
    Size(Index, u32),
    /// nothing from this place on
    Cut(Index),
    /// these bytes at the end
    Longer(Vec<u8>),
}

fn change() -> impl Strategy<Value = Change> {
    let odd = prop_oneof![
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(0.0),
        Just(-1.0),
        any::<f64>(),
        (-310.0..308.0f64).prop_map(|e| 10f64.powf(e)),
    ];
    let size = prop_oneof![Just(u32::MAX), Just(1 << 15), 0..100u32, any::<u32>()];
    prop_oneof![
        6 => (any::<Index>(), any::<u8>()).prop_map(|(i, x)| Change::Byte(i, x)),
        4 => (any::<Index>(), odd).prop_map(|(i, x)| Change::Number(i, x)),
        3 => (any::<Index>(), size).prop_map(|(i, x)| Change::Size(i, x)),
        1 => any::<Index>().prop_map(Change::Cut),
        1 => prop::collection::vec(any::<u8>(), 1..40).prop_map(Change::Longer),
    ]
}

fn apply(body: &mut Vec<u8>, change: &Change) {
    let put = |body: &mut Vec<u8>, place: usize, bytes: &[u8]| {
        for (slot, &byte) in body[place..].iter_mut().zip(bytes) {
            *slot = byte;
        }
    };
    let length = body.len().max(1);
    match change {
        Change::Byte(index, byte) => put(body, index.index(length).min(body.len()), &[*byte]),
        Change::Number(index, x) => {
            put(body, index.index(length).min(body.len()), &x.to_le_bytes());
        }
        Change::Size(index, x) => put(body, index.index(length).min(body.len()), &x.to_le_bytes()),
        Change::Cut(index) => body.truncate(index.index(length)),
        Change::Longer(more) => body.extend_from_slice(more),
    }
}

/// The cyclic redundancy check of IEEE 802.3.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, &byte: &u8| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg())
        })
    };
    !bytes.iter().fold(u32::MAX, step)
}

fn check((rule, samples, changes): (Index, u8, Vec<Change>)) {
    let subjects = all_subjects();
    let subject = &subjects[rule.index(subjects.len())];
    // now and then many parameters: some rules then keep more of P
    let n = if samples < 192 { 2 } else { 12 };
    let Some(mut estimator) = subject.estimator::<f64>((n, 1, 1), 0.97, 10.0) else { return };
    for k in 0..samples % 20 {
        let phi: Vec<f64> = (0..n).map(|i| f64::from(k * i as u8 % 5) - 2.0).collect();
        update(&mut estimator, &phi, &[f64::from(k % 3)], Noise::Unit).unwrap();
    }
    let mut body = estimator.to_bytes().unwrap();
    body.truncate(body.len() - 4);
    changes.iter().for_each(|change| apply(&mut body, change));
    let check = crc32(&body);
    body.extend_from_slice(&check.to_le_bytes());
    let Ok(mut read) = AnyEstimator::<f64>::from_bytes(&body) else { return };
    assert!(read.is_sound(), "{subject:?}");
    let memory = read.prior().memory();
    let (n, p, m) = (
        forgetting::Memory::parameters(&memory),
        forgetting::Memory::rows(&memory),
        forgetting::Memory::targets(&memory),
    );
    for _ in 0..3 {
        let _ = update(&mut read, &vec![0.5; p * n], &vec![1.0; p * m], Noise::Unit);
        assert!(read.is_sound(), "{subject:?}");
    }
}

#[test]
fn no_bytes_do_harm() {
    let strategy = || (any::<Index>(), any::<u8>(), prop::collection::vec(change(), 1..4));
    fuzz(("bytes", file!()), 3000, strategy, check);
}
