"""Text of users as it can be read: control characters are shown, so that none acts on a terminal or a drawing."""

from __future__ import annotations

_BIDIRECTIONAL = (0x061C, 0x200E, 0x200F, *range(0x202A, 0x202F), *range(0x2066, 0x206A))
_SEPARATORS = (0x2028, 0x2029)  # of lines and paragraphs
_LONE_SURROGATES = range(0xD800, 0xE000)  # bytes of file names that are not UTF-8; no stream takes them
_CONTROLS = (*range(0x20), *range(0x7F, 0xA0), *_BIDIRECTIONAL, *_SEPARATORS, *_LONE_SURROGATES)
_IN_A_LINE = {code: f"\\u{code:04x}" for code in _CONTROLS} | {ord("\n"): "\\n", ord("\t"): "\\t"}
_IN_LINES = {code: shown for code, shown in _IN_A_LINE.items() if chr(code) not in "\n\t"}


def visible(text: str) -> str:
    r"""Return a text of one or more lines with its control characters written out as `\u001b`.

    Written out are the controls of ISO 6429 (C0 but for line feed and tab, DEL, C1), which move the cursor, set
    titles and colours; the marks, embeddings, overrides and isolates of the Unicode bidirectional algorithm (UAX 9),
    which let a text be read in another order than it is stored; line and paragraph separators; lone surrogates.
    Line ends of Windows become line feeds. JSON writes characters in the same way, so JSON stays JSON with the same
    values.
    """
    return text.replace("\r\n", "\n").translate(_IN_LINES)


def visible_line(text: str) -> str:
    r"""Return a text as one line: as `visible`, with line feeds and tabs as `\n` and `\t` too."""
    return text.translate(_IN_A_LINE)
