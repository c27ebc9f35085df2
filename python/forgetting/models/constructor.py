"""Constructor arguments the scikit-learn way, without depending on scikit-learn."""

from __future__ import annotations

import inspect
from typing import Any, TypeVar

from forgetting._core import InvalidInput

Self = TypeVar("Self", bound="Constructor")


class Constructor:
    """Read and set the constructor's arguments by name; `clone` of scikit-learn works on it."""

    @classmethod
    def _names(cls) -> list[str]:
        return [name for name in inspect.signature(cls.__init__).parameters if name != "self"]

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """Return the constructor's arguments by name; `deep` is there for scikit-learn."""
        return {name: getattr(self, name) for name in self._names()}

    def set_params(self: Self, **parameters: Any) -> Self:
        """Set constructor arguments by name; they take effect at the next `fit`."""
        allowed = self._names()
        for name, value in parameters.items():
            if name not in allowed:
                raise InvalidInput(f"no parameter {name!r}; there are {', '.join(allowed)}")
            setattr(self, name, value)
        return self

    def __sklearn_is_fitted__(self) -> bool:
        return hasattr(self, "estimator_")

    def __repr__(self) -> str:
        given = ", ".join(f"{name}={value!r}" for name, value in self.get_params().items())
        return f"{type(self).__name__}({given})"
