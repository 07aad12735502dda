# SPDX-License-Identifier: GPL-2.0-or-later
"""Models made of their names, which have the form of the paper's: TypeD_120x40_2-4_1-circle_144000."""

import math
import re

from ..base.errors import InputError
from ..base.numerals import numeral
from ..base.presets import FORM
from .solid import RATIOS, SIZES, Grading, filling

_NUMBER = r"(\d{1,5}(?:\.\d{1,4})?)"
_NAME = re.compile(
    rf"Type[A-D]_{_NUMBER}x{_NUMBER}_(?:T-{_NUMBER}|{_NUMBER}-{_NUMBER})_([13])-circle_(\d{{1,8}}|auto)", re.ASCII
)
# by discs of a grain: template; power of the size law and loose column over the box, chosen for the 14 models
_GRAINS = {"1": ("single", -3, 1.8, "single discs"), "3": ("triple", 0, 2.2, "grains of three discs")}
_ROOM = 1.05  # least height of a loose column over that of the rows of grains in it


def model_text(name: str, friction: float = 0.0) -> str | None:
    """The file of the model that a name of the paper's form describes; None for any other name.

    friction: friction angle (degrees) with which grains are packed, on which it depends how many fill the box.
    """
    found = _NAME.fullmatch(name)
    if not found:
        return None
    wide, high, equal, least, greatest, discs, count = found.groups()
    width, half_height = float(wide) / 100, float(high) / 100
    dmin, dmax = (float(size) / 1000 for size in ((equal, equal) if equal else (least, greatest)))
    shape, power, loose, grains = _GRAINS[discs]
    power *= dmin < dmax
    if min(width, half_height, dmin) <= 0 or dmin > dmax:
        raise InputError(f"model {name}: lengths above 0 are expected, and the least size first. Names are {FORM}")
    if count == "auto" and dmax > RATIOS[-1] * dmin:
        raise InputError(f"model {name}: auto is for sizes up to 1 : {RATIOS[-1]:g}; a number of grains is expected")
    grading = Grading(dmin, dmax, power)
    ngrains = filling(shape, grading, width, 2 * half_height, friction) if count == "auto" else int(count)
    values = {
        "width": (numeral(width), "inner width of the box (m)"),
        "half_height": (numeral(half_height), "height of one half of the box (m)"),
        "dmin": (numeral(dmin), "diameters of a grain's largest disc (m)"),
        "dmax": (numeral(dmax), ""),
        "power": (str(power), "size law, number density n(d) ~ d^power"),
        "ngrains": (str(ngrains), f"as many as fill the box, packed with {friction:g} degrees" * (count == "auto")),
        "shape": (shape, "of a grain: a template of fix cdem/shape"),
    }
    rows = SIZES[shape] ** 2 * grading.diameters(ngrains).sum() * dmax / (width * 2 * half_height)
    column = max(loose, math.ceil(10 * _ROOM * rows) / 10)
    if column > 1.8:  # that of build.in
        values["loose"] = (numeral(column), "height of the loose column that is packed, over that of the box")
    sizes = f"{equal} mm" if equal else f"{least} to {greatest} mm"
    head = f"# Box of two halves of {wide} x {high} cm, {ngrains} {grains} of {sizes}."
    lines = [
        f"variable {name:11} index {value}" + f"   # {said}" * bool(said) for name, (value, said) in values.items()
    ]
    return "\n".join(["# SPDX-License-Identifier: GPL-2.0-or-later", head, *lines, ""])
