"""Writes ../src/generated/*.rs from the CIE tables in the Python package colour-science.

Run once, by hand, in this folder: pip install colour-science==0.4.7; python export_cie.py
The Rust files are committed; building the crate needs no Python.
"""

import pathlib

import colour

OUT = pathlib.Path(__file__).resolve().parent.parent / "src" / "generated"
VERSION = colour.__version__


def number(x):
    """The table's decimal digits: binary noise of the package's arithmetic rounded away."""
    x = float(f"{x:.12g}")
    return repr(x)


def observer(key, file, title, source):
    cmfs = colour.MSDS_CMFS[key]
    first, last = cmfs.wavelengths[0], cmfs.wavelengths[-1]
    assert cmfs.shape.interval == 1 and (first, last) == (360, 830)
    rows = "\n".join(
        "    [" + ", ".join(number(v) for v in row) + "]," for row in cmfs.values
    )
    (OUT / file).write_text(
        f"//! {title}, 360 to 830 nm by 1 nm [{source}], as tabulated in colour-science {VERSION}.\n"
        "//! Written by `codegen/export_cie.py`; don't edit.\n\n"
        "/// x, y, z at 360 nm, 361 nm, ..\n"
        f"pub(crate) const TABLE: [[f64; 3]; {len(cmfs.values)}] = [\n{rows}\n];\n"
    )


def illuminants():
    text = (
        "//! Relative spectral powers of CIE illuminants, 300 to 780 nm by 5 nm "
        f"[Cie15], as tabulated in\n//! colour-science {VERSION}.\n"
        "//! Written by `codegen/export_cie.py`; don't edit.\n"
    )
    for key in ["A", "D50", "D65"]:
        sd = colour.SDS_ILLUMINANTS[key]
        assert sd.shape.interval == 5
        assert (sd.wavelengths[0], sd.wavelengths[-1]) == (300, 780)
        values = ",\n    ".join(number(v) for v in sd.values)
        text += f"\n/// CIE {key} at 300 nm, 305 nm, ..\npub(crate) const {key}: [f64; {len(sd.values)}] = [\n    {values},\n];\n"
    (OUT / "illuminants.rs").write_text(text)


OUT.mkdir(exist_ok=True)
observer(
    "CIE 1931 2 Degree Standard Observer",
    "cie_1931_2deg.rs",
    "CIE 1931 standard observer (2 degree)",
    "Cie15",
)
observer(
    "CIE 1964 10 Degree Standard Observer",
    "cie_1964_10deg.rs",
    "CIE 1964 standard observer (10 degree)",
    "Cie15",
)
illuminants()
