//! The header of a rule's file is its documentation: it must say what the registry says.

use forgetting::rules::{Claim, RULES};

#[test]
fn headers_have_all_their_parts() {
    for about in RULES {
        let header: Vec<&str> = about.header().collect();
        let text = header.join("\n");
        let summary = about.summary();
        assert!(summary.ends_with('.') && summary.len() > 20, "{}: {summary}", about.name);
        assert!(header[1].is_empty(), "{}: one sentence, then a blank line", about.name);
        for part in ["```text", "| symbol | name | range | default |", "(A1)", "(A2)", "(A3)"] {
            assert!(text.contains(part), "{}: {part} is missing", about.name);
        }
        for part in ["Cost: ", "State: ", "Reference: "] {
            assert!(text.contains(part), "{}: {part} is missing", about.name);
        }
        for parameter in about.parameters {
            let name = format!("| {} |", parameter.name);
            assert!(text.contains(&name), "{}: {name} is missing", about.name);
        }
        assert!(about.source.contains(&format!("pub struct {}<M", about.type_name)));
    }
}

#[test]
fn headers_claim_what_the_registry_claims() {
    for about in RULES {
        let text = about.header().collect::<Vec<_>>().join("\n");
        for (mark, claim) in
            [("(A1)", about.proper), ("(A2)", about.bounded_above), ("(A3)", about.bounded_below)]
        {
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
    for (i, about) in RULES.iter().enumerate() {
        for other in &RULES[..i] {
            assert_ne!(about.name, other.name);
            assert_ne!(about.type_name, other.type_name);
        }
    }
}
