"""Why a claim is not supported: a sentence with the numbers behind it, or what its checks measured."""

from ..plotting.verdicts import measured_text, p_text
from .quantities import filled_in

CHANCE = 0.05  # significance that a trend needs (docs/claims.md)

# By claim; {measured} stands for what the main checks measured, other braces as in quantities.py.
EXPLANATIONS = {
    "3a": "R_n at z_0 = 0.955 is {R_n k_r=first z_0_target=0.955} at k_r = {k_r k_r=first:axis}, largest with {largest R_n k_r "
          "z_0_target=0.955}, and {R_n k_r=last z_0_target=0.955} at k_r = {k_r k_r=last:axis}. {measured}",
    "3d": "The gap z_0 for k_r = {k_r:axis}: under R_n = {R_n_target R_n_target=first:axis} it is {z_0 R_n_target=first}; "
          "under R_n = {R_n_target R_n_target=last:axis} it is {z_0 R_n_target=last}.",
    "4b": "R_x of bouncing bristles under nominal shear stress is {check predicate=level variable=R_x} times R_x under Coulomb "
          "friction of the same magnitude. Under either law, friction soon makes a tip that strikes the slab as fast as the "
          "slab, and what this takes depends on the tip and its springs, not on the law (docs/lift-off.md).",
    "4g": "From the lowest to the highest k_theta ln gamma_1, ln gamma_2 and ln gamma_3 change by {rise gamma_1 along "
          "k_theta:+.3f}, {rise gamma_2 along k_theta:+.3f} and {rise gamma_3 along k_theta:+.3f}.",
    "5c": "{measured} For pairs of points on either side of the jump of the gap it is {check variable=R_x_norm pairs=across}, "
          "for pairs on the same side {check variable=R_x_norm pairs=within}: R_x_norm and N_c_ratio change by factors of "
          "{end_ratio R_x_norm along k_r k_r=before} and {end_ratio N_c_ratio along k_r k_r=before} from k_r = {k_r "
          "k_r=before:range axis}, before the jump of the gap, and of {end_ratio R_x_norm along k_r k_r=behind} and {end_ratio "
          "N_c_ratio along k_r k_r=behind} from {k_r k_r=behind:range axis}, behind it.",
    "5d": "From k_phi = {k_phi k_phi=first:axis} to {k_phi k_phi=last:axis}, at k_r = {k_r k_r=first:axis} z_0 changes by a "
          "factor of {end_ratio z_0 along k_phi k_r=first} and R_x_norm by a factor of {end_ratio R_x_norm along k_phi "
          "k_r=first}, and at k_r = {k_r k_r=last:axis} z_0 changes by a factor of {end_ratio z_0 along k_phi k_r=last} and "
          "R_x_norm by a factor of {end_ratio R_x_norm along k_phi k_r=last}.",
    "6a": "From the lowest to the highest k_r ln R_x_norm, ln gamma_1 and ln gamma_2 change by {rise R_x_norm along k_r "
          "friction=coulomb:+.2f}, {rise gamma_1 along k_r friction=coulomb:+.2f} and {rise gamma_2 along k_r "
          "friction=coulomb:+.2f} under Coulomb friction, and by {rise R_x_norm along k_r friction=nss:+.2f}, {rise gamma_1 "
          "along k_r friction=nss:+.2f} and {rise gamma_2 along k_r friction=nss:+.2f} under NSS; along k_theta by {rise "
          "R_x_norm along k_theta friction=coulomb:+.2f}, {rise gamma_1 along k_theta friction=coulomb:+.2f} and {rise gamma_2 "
          "along k_theta friction=coulomb:+.2f}, and by {rise R_x_norm along k_theta friction=nss:+.2f}, {rise gamma_1 along "
          "k_theta friction=nss:+.2f} and {rise gamma_2 along k_theta friction=nss:+.2f}. A change by less than 0.05 has no "
          "direction.",
    "7b": "{measured} For pairs of points on either side of the jump of the gap under NSS it is {check pairs=across}, for "
          "pairs on the same side {check pairs=within}: R_x_norm and z_0 change by factors of {end_ratio R_x_norm along k_r "
          "friction=nss nominal_friction=last k_r=before} and {end_ratio z_0 along k_r friction=nss nominal_friction=last "
          "k_r=before} from k_r = {k_r friction=nss nominal_friction=last k_r=before:range axis}, before the jump of the gap, "
          "and of {end_ratio R_x_norm along k_r friction=nss nominal_friction=last k_r=behind} and {end_ratio z_0 along k_r "
          "friction=nss nominal_friction=last k_r=behind} from {k_r friction=nss nominal_friction=last k_r=behind:range axis}, "
          "behind it.",
    "8b": "At k_r = {k_r k_r=last:axis} and mu_c = {mu_c mu_c=2.5,5,10:axis}, {pinned_fraction k_r=last mu_c=2.5,5,10:percent} "
          "of the bristles are pinned upright at the pole and carry {pinned_share_R_x k_r=last mu_c=2.5,5,10:percent} of R_x. "
          "The slab slides over them at V_0, so their friction grows with mu_c: R_x is {R_x_pinned k_r=last mu_c=2.5,5,10} per "
          "pinned bristle. R_x of all bristles is {R_x k_r=last mu_c=2.5,5,10}; R_x of the bristles that pass is {R_x_unpinned "
          "k_r=last mu_c=2.5,5,10}: these do saturate. The caption of Figure 8 does not give k_theta, here {setting "
          "model/k_theta:g}, and the verdict depends on it (docs/assumptions.md). As printed {pinned_fraction "
          "bending=polar_as_printed k_r=last mu_c=2.5,5,10:most percent} of the bristles are pinned there, and R_x of all is "
          "{R_x bending=polar_as_printed k_r=last mu_c=2.5,5,10}; rods have no pole, and their R_x is {R_x bending=rod "
          "k_r=last mu_c=2.5,5,10}.",
    "8c": "At k_r = {k_r k_r=last:axis} and a local friction of {nominal_friction nominal_friction=10..25:axis} R_x is {R_x "
          "k_r=last friction=nss nominal_friction=10..25} under NSS ({R_x_unpinned k_r=last friction=nss "
          "nominal_friction=10..25} of the bristles that pass; pinned ones carry {pinned_share_R_x k_r=last friction=nss "
          "nominal_friction=10..25:range percent}); {R_x k_r=last friction=coulomb nominal_friction=10..25} under Coulomb "
          "friction ({R_x_unpinned k_r=last friction=coulomb nominal_friction=10..25}; {pinned_share_R_x k_r=last "
          "friction=coulomb nominal_friction=10..25:range percent}). The slab slides over pinned bristles, so their friction "
          "grows with the local one.",
    "C1": "{measured} From k_phi = {k_phi k_phi=first:axis} to {k_phi k_phi=last:axis} R_x_norm changes by a factor of "
          "{end_ratio R_x_norm along k_phi k_r=before} for k_r from {k_r k_r=before:range axis}, before the jump of the gap, "
          "and of {end_ratio R_x_norm along k_phi k_r=behind} from {k_r k_r=behind:range axis}, behind it.",
}


def explain_claim(file, pairs):
    """Why the claim is not supported under the reading of these pairs: each check, with the claim as measured."""
    main = [pair for pair in pairs if pair[1].role == "main"]
    if not main:
        found = " ".join(f"\u201c{row.statement}\u201d: {row.verdict}, {measured_text(row)} ({row.required})." for _, row in pairs)
        return f"No check of ours decides it. Beside it, {found}"
    parts = EXPLANATIONS.get(main[0][0]["claim"], "{measured}").split("{measured}")
    return what_was_measured(main).join(filled_in(part, file, main[0][1].reading, pairs) for part in parts)


def what_was_measured(pairs):
    """What checks measured that are not supported, and what they require."""
    rows = [row for _, row in pairs if row.verdict != "supported"] or [row for _, row in pairs]
    return " ".join(f"\u201c{row.statement}\u201d: measured {measured_text(row)}{p_text(row)} ({row.required}){by_chance(row)}." for row in rows)


def by_chance(row):
    """Of a trend that meets its threshold and is not supported."""
    return f", but so few points can show it by chance: p is to be at most {CHANCE}" if row.significance > CHANCE and row.margin > 0 else ""
