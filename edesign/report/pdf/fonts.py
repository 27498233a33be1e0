"""The fonts of the PDF: those that come with matplotlib, so that every machine breaks lines and pages alike."""

from __future__ import annotations

from pathlib import Path

FACES = (
    ("Report", "normal", "normal", "DejaVuSans.ttf"),
    ("Report", "bold", "normal", "DejaVuSans-Bold.ttf"),
    ("Report", "normal", "italic", "DejaVuSans-Oblique.ttf"),
    ("Report", "bold", "italic", "DejaVuSans-BoldOblique.ttf"),
    ("Report Mono", "normal", "normal", "DejaVuSansMono.ttf"),
)
"""Family, weight, style and file."""


def fonts_folder() -> Path:
    """Return the folder with the font files of matplotlib."""
    import matplotlib

    return Path(matplotlib.get_data_path()) / "fonts" / "ttf"


def font_faces() -> str:
    """Return the rules of CSS that name the fonts."""
    folder = fonts_folder()
    return "\n".join(
        f"@font-face {{ font-family: '{family}'; font-weight: {weight}; font-style: {style}; "
        f"src: url('{(folder / file).as_uri()}') }}"
        for family, weight, style, file in FACES
    )
