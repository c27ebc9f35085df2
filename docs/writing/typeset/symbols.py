"""What each letter and sign of a formula is in LaTeX."""

from __future__ import annotations

GREEK = {
    "α": r"\alpha",
    "β": r"\beta",
    "γ": r"\gamma",
    "δ": r"\delta",
    "ε": r"\varepsilon",
    "ζ": r"\zeta",
    "η": r"\eta",
    "θ": r"\theta",
    "κ": r"\kappa",
    "λ": r"\lambda",
    "μ": r"\mu",
    "ν": r"\nu",
    "ξ": r"\xi",
    "π": r"\pi",
    "ρ": r"\rho",
    "σ": r"\sigma",
    "τ": r"\tau",
    "φ": r"\varphi",
    "χ": r"\chi",
    "ψ": r"\psi",
    "ω": r"\omega",
    "Γ": r"\Gamma",
    "Δ": r"\Delta",
    "Λ": r"\Lambda",
    "Φ": r"\Phi",
    "Ψ": r"\Psi",
    "Σ": r"\Sigma",
    "ℓ": r"\ell",
}

SIGNS = {
    "−": "-",
    "-": "-",
    "–": r"\text{–}",
    "+": "+",
    "=": "=",
    "<": "<",
    ">": ">",
    "/": "/",
    "≤": r"\le ",
    "≥": r"\ge ",
    "≠": r"\ne ",
    "≈": r"\approx ",
    "≪": r"\ll ",
    "≫": r"\gg ",
    "∈": r"\in ",
    "∝": r"\propto ",
    "←": r"\leftarrow ",
    "→": r"\to ",
    "×": r"\times ",
    "·": r"\cdot ",
    "±": r"\pm ",
    "∞": r"\infty ",
    "∂": r"\partial ",
    "∇": r"\nabla ",
    "⌊": r"\lfloor ",
    "⌋": r"\rfloor ",
    "⌈": r"\lceil ",
    "⌉": r"\rceil ",
    "½": r"\tfrac12 ",
    "…": r"\dots ",
    "(": "(",
    ")": ")",
    "[": "[",
    "]": "]",
    "{": r"\{",
    "}": r"\}",
    ",": ",",
    ";": r";\;",
    ":": r"\colon ",
    ".": ".",
    "?": "?",
    "%": r"\%",
    "&": r"\&",
    "°": r"^\circ ",
}

FENCES = {"‖": (r"\lVert ", r"\rVert "), "|": (r"\lvert ", r"\rvert ")}

ABOVE = {
    **dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789", strict=True)),
    **dict(zip("ᵃᵇᶜᵈᵉᶠᵍʰⁱʲᵏˡᵐⁿᵒᵖʳˢᵗᵘᵛʷˣʸᶻ", "abcdefghijklmnoprstuvwxyz", strict=True)),
    "ᴺ": "N",
    "ᴷ": "K",
    "ᴾ": "P",
    "ᵀ": r"\mathsf{T}",
    "⁺": "+",
    "⁻": "-",
    "⁽": "(",
    "⁾": ")",
    "ᐟ": "/",
}

BELOW = {
    **dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True)),
    **dict(zip("ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ", "aehijklmnoprstuvx", strict=True)),
    "₊": "+",
    "₋": "-",
}

ACCENTS = {"\u0304": r"\bar", "\u0305": r"\bar", "\u0302": r"\hat", "\u0303": r"\tilde"}

FUNCTIONS = {
    **{name: rf"\{name}" for name in ("min", "max", "ln", "log", "exp", "det", "sup", "inf")},
    **{name: rf"\operatorname{{{name}}}" for name in ("tr", "diag", "blkdiag", "clip", "rank")},
    "mod": r"\bmod",
}
"""Words that are functions; all others in a formula are text."""

DIFFERENTIALS = {f"d{letter}": rf"\mathrm{{d}}{letter}" for letter in "JPVx"}

RELATIONS = "=<>≤≥≠≈∈∝←→≪≫"
