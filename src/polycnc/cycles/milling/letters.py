"""Letters as strokes of an engraving tool, of polycnc's own drawing.

A letter is a few lines, each a row of points, two digits a point: x from 0 to 4, y from 0 to 6. Capitals and figures
are 6 high; small letters with a tail have it above the base line, a size smaller, so that all stay on the line. A
letter with a mark (an umlaut, an accent) is the letter with the mark over it.
"""

from __future__ import annotations

from unicodedata import normalize

#: Height of a letter, and its width, in the units of the drawing.
HEIGHT, WIDTH = 6.0, 4.0
_LETTERS = {
    "A": "002640 1333",
    "B": "00063645443303 3342413000",
    "C": "453616050110303141",
    "D": "00062644422000",
    "E": "46060040 0333",
    "F": "460600 0333",
    "G": "4536160501103041432313",
    "H": "0006 4046 0343",
    "I": "1030 1636 2026",
    "J": "0110304146",
    "K": "0006 4603 1340",
    "L": "060040",
    "M": "0006234640",
    "N": "00064046",
    "O": "100105163645413010",
    "P": "00063645443303",
    "Q": "100105163645413010 2240",
    "R": "00063645443303 2340",
    "S": "453616050413334241301001",
    "T": "0646 2620",
    "U": "060110304146",
    "V": "062046",
    "W": "0610233046",
    "X": "0046 0640",
    "Y": "062346 2320",
    "Z": "06460040",
    "a": "0414343040 3210013230",
    "b": "0600304134 0434",
    "c": "4434140301103040",
    "d": "4640100103144440",
    "e": "0242341403011030",
    "f": "20253645 0343",
    "g": "4010020515444010",
    "h": "0600 0314344340",
    "i": "2024 2626",
    "j": "0010213400",
    "k": "0600 4401 1240",
    "l": "1626203040",
    "m": "0004 03142320 23344340",
    "n": "0004 0314344340",
    "o": "100103143443413010",
    "p": "0006364534140303",
    "q": "4046160514344343",
    "r": "0004 03143444",
    "s": "4414030232413000",
    "t": "2621304041 0444",
    "u": "040110304044",
    "v": "042044",
    "w": "0410233044",
    "x": "0044 0440",
    "y": "0421 440010",
    "z": "04440040",
    "0": "100105163645413010 0145",
    "1": "04262010 1030",
    "2": "0516364544000040",
    "3": "0516364544334241301001 2333",
    "4": "30360242",
    "5": "4606033342413010",
    "6": "4536160501103041423304",
    "7": "064610",
    "8": "1304051636454433130201103041423313",
    "9": "011030414536160504133344",
    ".": "2021",
    ",": "2110",
    ":": "2021 2324",
    ";": "2110 2324",
    "-": "1333",
    "+": "0343 2125",
    "*": "1135 3115 0343",
    "/": "0046",
    "\\": "0640",
    "=": "0242 0444",
    "_": "0040",
    "(": "3625212030",
    ")": "1625212010",
    "[": "36161030",
    "]": "16363010",
    "<": "450341",
    ">": "054301",
    "!": "2020 2226",
    "?": "05163645442322 2020",
    "#": "1016 3036 0242 0444",
    "%": "0046 0605 4140",
    "&": "40152636340101103042",
    "'": "2526",
    '"': "1516 3536",
    "@": "323414124245361605011040",
    "$": "453616050413334241301001 2026",
    "^": "042644",
    "`": "1624",
    "|": "2026",
    "~": "03143243",
    "{": "36262413222030",
    "}": "16262433222010",
    "ß": "0005162635342342413010",
    "Ç": "4536160503123243 222110",
    "ç": "44140302113142 2110",
    "Æ": "002646 262040 1343",
    "æ": "042420000222 22424424 2040",
    "Œ": "26160501102026 2646 2343 2040",
    "œ": "24140301102024 24444222 2040",
    "Ø": "100105163645413010 0046",
    "ø": "100103143443413010 0044",
    "€": "4536160501103041 0434 0232",
    "£": "45362615110040 0333",
    "¥": "062346 2320 1232",
    "§": "4536160514334231 0110304132130415",
    "°": "1416363414",
    "±": "0444 2226 0040",
    "×": "0145 0541",
    "÷": "0343 2526 2021",
    "²": "1526351333",
    "³": "163624 243313",
    "µ": "0004 0110304144 4140",
    "¿": "41301001022324 2626",
    "¡": "2626 2420",
    "©": "160501103041453616 34141232",
    "®": "160501103041453616 12143433 1333 2332",
}
#: Marks over a letter of 4; higher letters carry them higher.
_SMALL = 4.0
_MARKS = {
    "\N{COMBINING GRAVE ACCENT}": "1625",
    "\N{COMBINING ACUTE ACCENT}": "2536",
    "\N{COMBINING CIRCUMFLEX ACCENT}": "152635",
    "\N{COMBINING TILDE}": "05163546",
    "\N{COMBINING DIAERESIS}": "1516 3536",
    "\N{COMBINING RING ABOVE}": "1516363515",
    "\N{COMBINING CARON}": "162536",
}
#: Letters whose dot gives way to a mark.
_DOTTED = "ij"


def drawn(letter: str) -> list[list[tuple[float, float]]] | None:
    """The lines of a letter; none for a blank, None for one that is not drawn here."""
    if letter == " ":
        return []
    if letter in _LETTERS:
        return _lines(_LETTERS[letter])
    base, *marks = list(normalize("NFD", letter))
    if not marks or base not in _LETTERS or not all(mark in _MARKS for mark in marks):
        return None
    lines = _lines(_LETTERS[base])
    if base in _DOTTED:
        del lines[-1]
    rise = max(max(y for line in lines for _, y in line) - _SMALL, 0.0)
    return lines + [[(x, y + rise) for x, y in line] for mark in marks for line in _lines(_MARKS[mark])]


def _lines(drawing: str) -> list[list[tuple[float, float]]]:
    return [
        [(float(line[i]), float(line[i + 1])) for i in range(0, len(line), 2)] for line in drawing.split()
    ]
