"""The verdicts on all claims, and the findings that a reader should know first, as sentences."""

from ..plotting.verdicts import declared_checks
from ..results import as_text
from .quantities import READINGS, filled_in


def claims_of(file):
    """By claim, in the order of the experiment's checks: (check, its rows, one for each reading)."""
    claims = {}
    for check, row in declared_checks(file):
        claims.setdefault(check["claim"], {}).setdefault(row.declared, (check, []))[1].append(row)
    return {claim: list(checks.values()) for claim, checks in claims.items()}


def verdicts_of(checks):
    """The verdict on a claim by reading."""
    return {row.reading: row.claim_verdict for row in checks[0][1]}


OWN = "F"  # the first letter of the findings that are ours; all other claims are the paper's


def all_verdicts(found):
    """By claim of the paper, the verdict by reading."""
    return {claim: verdicts for claim, verdicts in every_verdict(found).items() if not claim.startswith(OWN)}


def own_verdicts(found):
    """By finding of ours, the verdict by reading."""
    return {claim: verdicts for claim, verdicts in every_verdict(found).items() if claim.startswith(OWN)}


def every_verdict(found):
    """The verdict by reading, in the order of the claims."""
    every = {}
    for _, claims in found:
        for claim, checks in claims.items():
            verdicts = every.setdefault(claim, {})
            for reading, verdict in verdicts_of(checks).items():
                verdicts[reading] = joint(verdict, verdicts.get(reading, verdict))
    return dict(sorted(every.items()))


def joint(*verdicts):
    """The verdict on a claim that checks of several results decide: supported if all support it, refuted if one refutes it."""
    return min(verdicts, key=["refuted", "depends", "undecided", "supported"].index)


def readings_of(found):
    return list(dict.fromkeys(reading for verdicts in all_verdicts(found).values() for reading in verdicts))


# Of each finding, the claim that its sentences repeat, the result with their numbers, and the sentences, as in quantities.py;
# what follows the first claim is said if that holds.
FINDINGS = [
    [("F1", "load",
      "**Under strong local friction a brush of point masses is in contact or bounces.** In contact the tips stay on the slab "
      "and drag along it. Bouncing, they are off the slab for {level off_slab_share along R_n_target off_slab_share=0.5..1 "
      "all:percent} of the time (L_x = {setting model/L_x:g}). Of the {count phase=contact,bouncing,mixed} points of `make "
      "load` with a value (local friction {local_friction:range .2g}), {count phase=mixed} are in between.")],
    [("F3", "liftoff",
      "**A formula says when.** If the slab is lowered, a brush of point masses bounces below a certain load per bristle, the "
      "lift-off load. A formula (docs/lift-off.md) gives this load with a root mean square error of {scatter_of_formula:most "
      "percent} for a radial over polar stiffness, k_r/k_phi, of 4 to 36 and a local friction of 3 to 20. Straight rods lie "
      "outside this range.")],
    [("F2", "load",
      "**Bouncing point masses slide easily.** In `make load` (rods, k_r from {k_r k_r=first:axis} to {k_r k_r=last:axis}) "
      "bouncing brushes have {R_x_norm bending=rod phase=bouncing load_over_lift_off=0.5..1000:range .2g} times the friction "
      "of rigid bristles, under loads of at least half the lift-off load; brushes in contact have {R_x_norm bending=rod "
      "phase=contact:range .2g} times. Stiffness decides at which load a brush falls into contact, and changes the friction of "
      "either kind less.")],
    [("F4", "hysteresis",
      "**Near the lift-off load a brush of point masses has two frictions.** Friction is higher if the slab was raised from "
      "the ground than if it was lowered from above: for rods under a load of {setting load/R_n:g}, {windows rod}."),
     ("F6", "scatter",
      "Both frictions remain if the bristles of a brush differ, by standard deviations of up to {scatter_r0:most percent} in "
      "length or {scatter_E:most percent} in modulus.")],
    [("F5", "chart",
      "**Weak local friction cannot be controlled if bristles are soft along their axis.** If the local friction is 0.43 or "
      "less, rods with k_r/k_phi = {setting model/k_r / setting model/k_phi:.3g} have at least {R_x_norm "
      "nominal_friction=0..0.43:least percent} of the friction of rigid bristles, whatever the load ({R_n_target:range axis}; "
      "L_x = {setting model/L_x:g}). Where the local friction exceeds cot(phi_0), {cot model/phi_0_deg} at {setting "
      "model/phi_0_deg:g} degrees, bristles that are stiff along their axis lock, vault over the vertical, and have less "
      "friction, under axial forces that would buckle their shafts.")],
]
LIMITS = (
    "**Before you trust a number:** in the paper's Figure 4, at {beyond exceeds_buckling} the axial force is more than 4 times "
    "the load under which a straight shaft buckles; at {beyond exceeds_spacing} the tips travel beyond the next bristle, which "
    "the model lets them pass through; and at {beyond exceeds_strain_limit} the roots are strained beyond the linear range. "
    "And all of this holds only for point masses: bristles whose tips are heavier than their shafts, or pins in springy "
    "sockets. For bristles with their mass along their length, such as wires and fibres, it is not settled: the first "
    "computations found neither the jump nor the lift-off load (docs/lift-off.md).")
ON_CLAIMS = [
    ("fig7",
     "Stiffer bristles have less friction because of one jump (nominal shear stress, Figure 7): {rise R_x_norm along k_r "
     "friction=nss nominal_friction=last k_r=jump / rise R_x_norm along k_r friction=nss nominal_friction=last each:percent} "
     "of the fall of ln R_x_norm from k_r = {k_r k_r=first:axis} to {k_r k_r=last:axis} lies within three of {steps k_r} steps "
     "of k_r, at k_r of about {steepest_fall R_x_norm along k_r friction=nss nominal_friction=last each:axis}. Up to there "
     "R_x_norm changes by a factor of {end_ratio R_x_norm along k_r friction=nss nominal_friction=last k_r=before each}. At "
     "the jump the slab rises from one branch of gaps to another, and the load becomes spiky, so that the contact area under "
     "it, gamma_3, falls by a factor of {1 / end_ratio gamma_3 along k_r friction=nss nominal_friction=last k_r=jump each}."),
    ("fig7",
     "The paper names the friction law as the cause: a steep fall under nominal shear stress, a smoother one under Coulomb "
     "friction (6b, 7a). But its two laws differ in magnitude, too: rigid bristles have a friction of {nominal_friction "
     "nominal_friction=last:.2g} times the load under the first, and of {nominal_friction nominal_friction=first:axis} under "
     "the second. At {nominal_friction nominal_friction=last:.2g} R_x_norm falls from k_r = {k_r k_r=first:axis} to {k_r "
     "k_r=last:axis} by a factor of {1 / end_ratio R_x_norm along k_r friction=nss nominal_friction=last each} under nominal "
     "shear stress and of {1 / end_ratio R_x_norm along k_r friction=coulomb nominal_friction=last each} under Coulomb "
     "friction; at {nominal_friction nominal_friction=first:axis} by {1 / end_ratio R_x_norm along k_r friction=nss "
     "nominal_friction=first each} and {1 / end_ratio R_x_norm along k_r friction=coulomb nominal_friction=first each} (below "
     "1: it rises). So law and magnitude both matter for this fall; once a brush bounces, the law hardly matters "
     "(docs/lift-off.md)."),
    ("fig7",
     "The paper says that friction falls \u201cmostly due to the reduction of the effective contact area\u201d (4b). Coulomb "
     "friction of the same magnitude, which no contact area enters, has {rise R_x_norm along k_r friction=coulomb "
     "nominal_friction=last / rise R_x_norm along k_r friction=nss nominal_friction=last each:percent} of the fall of ln "
     "R_x_norm."),
]


def in_short(found):
    """What a reader should know first, of the results that are there: the findings that every model of bending supports."""
    files, verdicts = files_of(found), own_verdicts(found)

    def holds(claim, name, _):
        return name in files and set(verdicts[claim].values()) == {"supported"}

    return [" ".join(filled_in(part[2], files[part[1]]) for part in finding if holds(*part)) for finding in FINDINGS if holds(*finding[0])]


def in_context(found):
    """What belongs to the findings: the paper's claims in numbers, and what a reader must not take from its figures."""
    lines = [counts(all_verdicts(found), readings_of(found))] if all_verdicts(found) else []
    return [*lines, *(filled_in(LIMITS, file) for name, file in files_of(found).items() if name == "fig4")]


def further(found):
    """Findings on single claims of the paper."""
    files = files_of(found)
    return [filled_in(sentences, files[name]) for name, sentences in ON_CLAIMS if name in files]


def files_of(found):
    """The results by name, without those that lack a model of bending which others have."""
    return {as_text(file.attrs["name"]): file for file, _ in found if "bending" not in file.dims or file.sizes["bending"] == len(READINGS)}


def counts(verdicts, readings):
    """How many claims hold with every model, how many fail with every model, and how many depend on the model."""
    words = {claim: set(found.values()) if len(found) == len(readings) else {""} for claim, found in verdicts.items()}
    holding, failing = ([claim for claim, found in words.items() if found == {word}] for word in ("supported", "refuted"))
    rest = len(verdicts) - len(holding) - len(failing)
    by_model = (" and {} depend on the model, on a range or on what is meant, or are undecided" if len(readings) > 1 else
                " and {} depend on what is meant or are undecided").format(rest)
    model = " with every model of bending" if len(readings) > 1 else ""
    fails = "fails" if len(failing) == 1 else "fail"
    return (f"Of the paper's {len(verdicts)} claims, {len(holding)} hold{model}, {len(failing)} {fails}{model}"
            f"{' (' + ', '.join(failing) + ')' if failing else ''}{by_model}.")
