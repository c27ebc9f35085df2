//! The feature `serde`: what is written by any of its formats goes on bit for bit when it is read.

use forgetting::bank::{default_members, default_mixer, Bank};
use forgetting::choice::Defaults;
use forgetting::models::{InputOrders, Method, Orders, Polynomial};
use forgetting::rates::{AnyRate, Constant};
use forgetting::rules::Rule;
use forgetting::weightings::AnyWeighting;
use forgetting::{AnyEstimator, Dynamic, Equal, Estimator, Memory, Named, Noise, Prior, UpTo};
use serde::de::value::{BytesDeserializer, Error};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

fn estimator<M: Memory<Real = f64>>(memory: M) -> Named<M> {
    let rule = Rule::named("subspace", &Defaults, memory).unwrap();
    let rate = AnyRate::Constant(Constant::new(0.98).unwrap());
    let prior = Prior::scalar(memory, 100.0).unwrap();
    let mut made = Estimator::new(rule, rate, AnyWeighting::Equal(Equal::new()), prior);
    for k in 0..20 {
        made.update(&[1.0, f64::from(k % 7)], &[3.0 + 0.5 * f64::from(k % 7)]).unwrap();
    }
    made
}

fn bank() -> Bank<f64> {
    let members = default_members(Dynamic::new(2, 1, 1).unwrap()).unwrap();
    let mut bank = Bank::of_data(members, default_mixer().unwrap()).unwrap();
    for k in 0..20 {
        let phi = [1.0, f64::from(k % 7)];
        bank.update(&phi, &[3.0 + 0.5 * phi[1]], Noise::Unit).unwrap();
    }
    bank
}

fn model() -> Polynomial {
    let inputs = vec![InputOrders { nb: 2, nf: 1, nk: 1 }];
    let orders = Orders { na: 0, nc: 1, nd: 0, inputs, constant: true };
    Polynomial::new(orders, Method::PredictionError).unwrap()
}

/// Through text, and through bytes, which are `expected`.
fn both_ways<S: Serialize + DeserializeOwned>(
    one: &S,
    expected: &[u8],
    bytes: impl Fn(&S) -> Vec<u8>,
) {
    let text = serde_json::to_string(one).unwrap();
    assert_eq!(serde_json::from_str::<Vec<u8>>(&text).unwrap(), expected);
    assert_eq!(bytes(&serde_json::from_str(&text).unwrap()), expected);
    let read = S::deserialize(BytesDeserializer::<Error>::new(expected)).unwrap();
    assert_eq!(bytes(&read), expected);
}

#[test]
fn an_estimator_a_bank_and_a_model_go_both_ways() {
    let one: AnyEstimator<f64> = estimator(Dynamic::new(2, 1, 1).unwrap());
    both_ways(&one, &one.to_bytes().unwrap(), |read| read.to_bytes().unwrap());
    both_ways(&bank(), &bank().to_bytes().unwrap(), |read| read.to_bytes().unwrap());
    both_ways(&model(), &model().to_bytes(), Polynomial::to_bytes);
}

#[test]
fn an_estimator_moves_between_kinds_of_memory() {
    let text = serde_json::to_string(&estimator(UpTo::<f64, 4>::new(2).unwrap())).unwrap();
    let read: AnyEstimator<f64> = serde_json::from_str(&text).unwrap();
    assert_eq!(read.theta(), estimator(Dynamic::new(2, 1, 1).unwrap()).theta());
}

/// What a program of somebody else's keeps.
#[derive(Serialize, Deserialize)]
struct Cell {
    name: String,
    resistance: AnyEstimator<f64>,
}

#[test]
fn it_is_a_field_like_any_other() {
    let resistance = estimator(Dynamic::new(2, 1, 1).unwrap());
    let text = serde_json::to_string(&Cell { name: "A1".into(), resistance }).unwrap();
    let read: Cell = serde_json::from_str(&text).unwrap();
    assert_eq!((read.name.as_str(), read.resistance.samples()), ("A1", 20));
}

#[test]
fn what_was_altered_is_refused_in_words() {
    let mut bytes = bank().to_bytes().unwrap();
    let refused = |bytes: &[u8]| {
        let text = serde_json::to_string(bytes).unwrap();
        serde_json::from_str::<Bank<f64>>(&text).unwrap_err().to_string()
    };
    bytes[60] ^= 1;
    assert!(refused(&bytes).contains("altered"), "{}", refused(&bytes));
    assert!(refused(&[]).contains("not a saved bank"), "{}", refused(&[]));
    let words = serde_json::from_str::<Bank<f64>>("{}").unwrap_err().to_string();
    assert!(words.contains("the bytes of a saved bank"), "{words}");
}
