"""What a client's script looks like to a type checker."""

import numpy as np
from numpy.typing import NDArray

import mdr_core as mdr

medium = mdr.Medium.from_bodies(E1=78e9, nu1=0.42, q_c=100.0)
many = mdr.Medium(E_star=np.array([1e9, 2e9]), q_c=[1.0, 2.0])
modulus: float = float(medium.E_star) * 2
moduli: float | NDArray[np.float64] = many.E_star
tip = mdr.Sphere(radius=200e-9)
path = mdr.indent(tip, medium, depth=[10e-9, 5e-9, 8.5e-9])
force: NDArray[np.float64] = path.force
largest = force.max() + path.force.mean() + path.contact_radius[-1]
state = path[-1]
rounded: float = round(state.force, 3)
text = f"{state.contact_radius * 1e9:.2f} nm, {state.pressure(0.0) / 1e9:.3f} GPa"
pressure: NDArray[np.float64] = state.pressure(np.linspace(0.0, 1e-8, 5))
for each in path:
    print(each.depth, each.stored_energy, each.mean_pressure, len(path), path.shape)
for limit in path.limits:
    print(limit.what, limit.value + limit.bound, limit.exceeded, limit.sentence.upper())
hit = mdr.impact(mdr.Cone(slope=[0.1, 0.3]), medium, mass=1e-12, speed=0.1)
fast = hit.fast_limit.max_depth_error
restitution: NDArray[np.float64] = hit.restitution
longest = hit.contact_time.max()
motion = hit[0].motion(50)
energy = motion.kinetic_energy + motion.stored_energy + motion.plastic_work
turning: int = motion.turning_index
drop = mdr.impact(mdr.Paraboloid(2e-3), mdr.Medium(4e6, q_c=200.0, eta=30.0), 1e-4, 0.5)
chain = mdr.chain_impact(mdr.Paraboloid(2e-3), mdr.Medium(4e6, q_c=200.0, eta=30.0), 1e-4, 0.5)
difference = abs(chain.restitution - drop.restitution)
ramp = mdr.indent_in_time(mdr.Cone.from_half_angle(70.3), medium, [0.0, 1e-9], [0.0, 1.0])
hold = mdr.creep(mdr.Cone.berkovich(), medium, [0.0, 1e-6], np.array([0.0, 1.0]))
settled = hold.depth[-1] - ramp.force.min()
scene = mdr.Scene(tip, medium, mdr.scene.DepthPath([1e-9, 2e-9]))
again = mdr.Scene.from_json(scene.to_json()).solve()
table: dict[str, float | NDArray[np.float64]] = path.to_dict()
fitted = mdr.Sampled.fit([-1e-9, 0.0, 1e-9, 2e-9], [1e-9, 0.0, 1e-9, 3e-9])
depth = mdr.indent_to_force(fitted, medium, 1e-9).depth
cusp = mdr.PowerLaw(coefficient=2e-4, exponent=0.5).reduced([1e-9, 2e-9])[0]
cap = mdr.Sphere([1e-6, 2e-6]).contact_radius(1e-9)
fit = mdr.fit_indentation(tip, path.depth, path.force, E_star=1e9, contact_point=0.0)
told: str = " ".join(fit.remarks) + f"{fit.medium.q_c} ± {fit.standard_errors['q_c']}"
doubts: list[str] = [f"{each.kind}: {each.text}" for each in (*fit.remarks, *tip.remarks)]
cures: list[tuple[str, str]] = [(cure.action, cure.what) for each in fit.remarks for cure in each.remedy]
quoted: str = fit.quoted.kind or fit.quoted.reason


def read_and_fit(path: str) -> float:
    """Of a file, in the place of depth and force."""
    curve = mdr.read_curve(path)
    fits = mdr.fit_indentation(mdr.Cone(0.3), mdr.read_curves(path), q_c=np.inf, time=None)
    return float(mdr.oliver_pharr(mdr.Cone(0.3), curve).E_star) + float(fits[0].contact_point)


hard = mdr.fit_hardness(mdr.Cone(0.3), [1e9, 5e8, 2.5e8], [1e-7, 2e-7, 4e-7], E_star=1e11)
kind: str | None = hard.class_of_hardness.letter
ball = mdr.Ball(1e-9, 1e-5)
bounce = mdr.oblique_impact(
    mdr.Paraboloid(1e-5), medium, 1e-9, *mdr.at_angle(0.1, 0.5), 0.3, tangential_mass=ball.tangential_mass
)
forward, turning_rate = ball.rebound(bounce, 0.05)
inner = state.stress(0.0, [0.0, 1e-9]).von_mises.max() + state.stress_peak("von_mises").value
deepest = state.largest_stress([1e-9, 2e-9]).max() + fit.to_dict()["q_c"]
slips = bounce.motion(20).stick_radius.max() + bounce.errors.friction_work * bounce.rebound_angle
plate = mdr.Structure.plate(2e-3, E=70e9, nu=0.33, density=2700.0, edge=[0.05, 0.1])
on_plate = mdr.impact(tip, medium, 1e-12, 0.1, structure=plate.entries(0)).max_deflection + plate.impedance
laminate = mdr.Medium.from_transversely_isotropic(52e9, 9e9, 0.31, 0.06, 4e9, hardness=0.5e9).E_star


def refused() -> None:
    """What a type checker refuses: a strict one reports a comment that is not needed."""
    mdr.Sphere(radius="one micron")  # type: ignore[arg-type]
    mdr.Medium(E_star="1 GPa")  # type: ignore[arg-type]
    mdr.indent(tip, medium, "abc")  # type: ignore[arg-type]
    mdr.impact(tip, medium, ["a"], 0.1)  # type: ignore[arg-type]
