"""Laws of hardness for tests, as a user writes them."""

from dataclasses import dataclass

import numpy as np

from mdr_core import HardnessLaw


@dataclass(frozen=True)
class Written(HardnessLaw):
    """The sum of the paper's classes, H + q/a + f/a², with nothing but its value and its rate."""

    H: float
    q: float
    f: float

    def at(self, a):
        return self.H + self.q / a + self.f / a**2

    def rate(self, a):
        return -self.q / a**2 - 2 * self.f / a**3


@dataclass(frozen=True)
class NixGao(HardnessLaw):
    """Nix and Gao's size effect, H₀ √(1 + a*/a)."""

    H0: float
    a_star: float

    def at(self, a):
        return self.H0 * np.sqrt(1 + self.a_star / a)

    def rate(self, a):
        return -(self.H0**2) * self.a_star / (2 * a**2 * self.at(a))


@dataclass(frozen=True)
class Decaying(HardnessLaw):
    """H (k + e^(−a/L)): a σ_c falls with the radius from a = L to where k takes over."""

    H: float
    k: float
    L: float

    def at(self, a):
        return self.H * (self.k + np.exp(-a / self.L))

    def rate(self, a):
        return -self.H / self.L * np.exp(-a / self.L)


@dataclass(frozen=True)
class Layered(HardnessLaw):
    """A smooth step at the radius L, from H down to (1 − k) H, of the width w in ln a."""

    H: float
    k: float
    L: float
    w: float

    def at(self, a):
        return self.H * (1 - self.k * (1 + np.tanh(np.log(a / self.L) / self.w)) / 2)

    def rate(self, a):
        place = np.clip(np.log(a / self.L) / self.w, -300, 300)
        return -self.H * self.k / (2 * self.w * a * np.cosh(place) ** 2)


@dataclass(frozen=True)
class Kinked(HardnessLaw):
    """The larger one of H and H L/a."""

    H: float
    L: float

    def at(self, a):
        return self.H * np.maximum(1.0, self.L / a)

    def rate(self, a):
        return np.where(a < self.L, -self.H * self.L / a**2, 0.0)


@dataclass(frozen=True)
class Wrong(HardnessLaw):
    """No law of hardness under a ball from about 0.1 µm on; `fault` says why."""

    fault: str

    def at(self, a):
        return {
            "grows": 1e9 * (a / 1e-6) ** 2,
            "negative": 1e9 - 1e16 * a,
            "NaN": np.where(a > 1e-7, np.nan, 1e9),
            "jumps up": np.where(a > 1e-7, 1.02e9, 1e9),
            "jumps down": np.where(a > 1e-7, 0.5e9, 1e9),
            "other rate": 1e9 * np.sqrt(1 + 1e-6 / a),
            "infinite": np.where(a > 1e-7, np.inf, 1e9),
        }[self.fault]

    def rate(self, a):
        rates = {"grows": 2e9 * a / 1e-12, "negative": -1e16 + 0 * a, "other rate": -1e3 / a**2}
        return rates.get(self.fault, 0 * a)


#: What is said of each `Wrong` law.
FAULTS = {
    "grows": "grows with the contact radius",
    "negative": "must be finite and above 0",
    "NaN": "must be finite and above 0",
    "jumps up": "jumps",
    "jumps down": "jumps",
    "other rate": r"rate\(a\) = .* correct rate",
    "infinite": "must be finite and above 0",
}
