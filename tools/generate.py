"""Writes again all that is generated from the registries: the type stub and the README's table."""

import readme
import stubs

if __name__ == "__main__":
    readme.write()
    stubs.STUB.write_text(stubs.stub(), encoding="utf-8")
