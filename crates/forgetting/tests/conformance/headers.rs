//! The header of a file is its documentation: it must have all its parts, and say what the registry
//! says.

use forgetting::choice::{About, Claim};
use forgetting::rules::RULES;
use forgetting::AXES;

fn text(about: &About) -> String {
    about.header().collect::<Vec<_>>().join("\n")
}

#[test]
fn headers_have_all_their_parts() {
    for about in AXES.iter().flat_map(|axis| axis.entries) {
        let (name, summary, text) = (about.name, about.summary(), text(about));
        assert!(summary.ends_with('.') && summary.len() > 20, "{name}: {summary}");
        let second = about.header().nth(1);
        assert_eq!(second, Some(""), "{name}: one sentence, then a blank line");
        for part in ["```text", "| symbol | name | range | default |", "Cost: ", "- Use it"] {
            assert!(text.contains(part), "{name}: {part} is missing");
        }
        for parameter in about.parameters {
            assert!(text.contains(&format!("| {} |", parameter.name)), "{name}: {parameter:?}");
            assert!(!parameter.about.is_empty(), "{name}: {parameter:?}");
        }
    }
}

#[test]
fn headers_of_rules_say_what_is_guaranteed_and_by_whom() {
    for about in RULES {
        for part in ["(A1)", "(A2)", "(A3)", "State: ", "Reference: "] {
            assert!(text(about).contains(part), "{}: {part} is missing", about.name);
        }
        assert!(!about.cost.is_empty(), "{}: its cost", about.name);
    }
}

#[test]
fn an_axis_says_what_it_is() {
    for axis in AXES {
        let summary = axis.summary().collect::<Vec<_>>().join(" ");
        assert!(summary.ends_with('.') && summary.len() > 20, "{}: {summary}", axis.name);
        assert!(!axis.entries.is_empty(), "{}", axis.name);
        assert!(axis.entries.iter().all(|about| axis.find(about.name).is_some()));
    }
}

#[test]
fn headers_claim_what_the_registry_claims() {
    for about in RULES {
        let text = text(about);
        let said = about.guarantees.expect("what the rule guarantees");
        for (mark, claim) in [
            ("(A1)", said.proper.claim),
            ("(A2)", said.bounded_above.claim),
            ("(A3)", said.bounded_below.claim),
        ] {
            let said = text.split(mark).nth(1).unwrap().trim_start_matches(": ");
            let fits = match claim {
                Claim::Always => said.starts_with("always"),
                Claim::If(_) => said.starts_with("if ") || said.starts_with("always, for"),
                Claim::No => said.starts_with("no"),
            };
            assert!(fits, "{} {mark}: {claim:?}, but the header says: {said}", about.name);
        }
    }
}

#[test]
fn names_are_unique() {
    for axis in AXES {
        for (i, about) in axis.entries.iter().enumerate() {
            assert!(axis.entries[..i].iter().all(|other| about.name != other.name));
        }
    }
    // types of all axes are names of one Python module
    let types: Vec<_> = AXES.iter().flat_map(|axis| axis.entries).map(|a| a.type_name).collect();
    for (i, one) in types.iter().enumerate() {
        assert!(!types[..i].contains(one), "{one}");
    }
}
