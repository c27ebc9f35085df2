"""The package against the references of tests/reference."""
