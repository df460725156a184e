"""From the bytes of a file to its characters. Never fails: what cannot be read becomes U+FFFD.

The order of detection, which `docs/programs.md` explains to users:

1. a byte order mark (UTF-8, UTF-16);
2. pure ASCII;
3. valid UTF-8;
4. the best score of damaged UTF-8, Big5, GB18030, Shift-JIS and Latin-1, the earlier one if two are equal.

Scores look only at the runs of bytes that are not ASCII. In a part program these are comments and messages: a
few characters of shop talk, written by hand. So a character counts most if it is one of the field (`tool`,
`hole`, `rough`), some if the standard has it among its frequent ones, and against the encoding if it is rare,
absent, or stands where it never stands.
"""

from __future__ import annotations

import codecs
import re

from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.program.errors import ProgramFileError
from polycnc.program.text import TAPE_CONTROLS

if TYPE_CHECKING:
    from collections.abc import Iterator

SAMPLE_BYTES = 16_384
"""So many bytes of non-ASCII runs decide; more would change nothing but the time."""

_BOMS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_RUN = regex(rb"[\x80-\xff][\x30-\xff]*")
_CONTROLS = TAPE_CONTROLS.encode("ascii")
_DROP_CONTROLS = dict.fromkeys(map(ord, TAPE_CONTROLS))

_OF_THE_FIELD, _FREQUENT, _RARE, _UNREADABLE = 3.0, 1.0, -2.0, -4.0


@dataclass(frozen=True, slots=True)
class Decoded:
    """A text, the codec that gave it, and how many of its characters had to be replaced."""

    text: str
    encoding: str
    replaced: int


@dataclass(frozen=True, slots=True)
class _DoubleByte:
    """A double-byte encoding: code ranges of its frequent characters, and the characters of the field."""

    codec: str
    frequent: tuple[tuple[int, int], ...]
    field: frozenset[str]


_BIG5 = _DoubleByte(
    "cp950",
    # Symbols, and the 5,401 characters of level 1.
    ((0xA140, 0xA3BF), (0xA440, 0xC67E)),
    frozenset(
        "程式刀具加工粗精銑鑽孔外徑內軸主換座標補正償工件夾治面深度進給轉速攻牙倒角輪廓槽中心定位暫停開始結束檔名"
        "日期材料鋁鋼銅鐵模仁球圓鼻平端長半直號第一二三四五六七八九十上下左右前後高低大小時間分秒完成檢查注意測試"
        "機台床客戶產品圖作者版本修改安全原點回零切削液冷卻水關吹氣副呼叫循環迴圈距絞鏜搪絲預側光清不的有為到用"
        "車尾座頭螺紋斷差餘量留寬厚毛胚胎料請先再次尺寸修底壁邊滑塊頂針電極，、。：（）"
    ),
)
_GB18030 = _DoubleByte(
    "gb18030",
    # Symbols, and the 3,755 characters of level 1.
    ((0xA1A1, 0xA3FE), (0xB0A1, 0xD7F9)),
    frozenset(
        "程序刀具加工粗精铣钻孔外径内轴主换坐标补正偿工件夹治面深度进给转速攻丝牙倒角轮廓槽中心定位暂停开始结束文件名"
        "日期材料铝钢铜铁模仁球圆鼻平端长半直号第一二三四五六七八九十上下左右前后高低大小时间分秒完成检查注意测试"
        "机台床客户产品图作者版本修改安全原点回零切削液冷却水关吹气子调用循环圈距铰镗锪预侧光清不的有为到"
        "车尾座头螺纹断差余量留宽厚毛坯料请先再次尺寸修底壁边滑块顶针电极，、。：（）"
    ),
)
_SHIFT_JIS = _DoubleByte(
    "cp932",
    # Symbols and wide letters, hiragana, katakana, and the 2,965 characters of level 1.
    ((0x8140, 0x829A), (0x829F, 0x82F1), (0x8340, 0x8396), (0x889F, 0x9872)),
    frozenset(
        "加工荒仕上穴径工具交換主軸回転送座標原点復帰面取深切削油内外溝端中心位置決定補正長番号第一二三四五六七八九十"
        "下左右前後大小時間完了開始終了確認注意停止材料鋼図品名機械部旋盤測定戻"
        "のをはにとがでしてるすたれなあいうおかきくけこもよらりンドリルタップエミバイトスクッコアイセオラシフテネジー"
    ),
)

_NARROW_KANA = regex("[\uff61-\uff9f]+")
_NARROW_WORDS = regex("ﾄﾞﾘﾙ|ﾀｯﾌﾟ|ﾐﾙ|ｾﾝﾀ|ﾒﾝ|ｼｱｹ|ｱﾗ|ﾈｼﾞ|ﾎﾞｰ|ｶｯﾀ|ﾘｰﾏ|ﾐｿﾞ|ﾅｲｹｲ|ｶﾞｲｹｲ|ﾊﾞｲﾄ|ｺｳｸﾞ|ﾜｰｸ|ｱﾅ")

_LATIN = frozenset("ÀÁÂÄÅÆÇÈÉÊËÍÎÏÑÓÔÖØÙÚÛÜßàáâäåæçèéêëíîïñóôöøùúûü°±²³µ×")
_LATIN_SIGNS = frozenset("¡£§©«®´·»¼½¾¿ÃÌÒÕÝãìòõýÿ")


def decode(data: bytes, override: str | None = None) -> Decoded:
    """Decode the bytes of a program file and drop the control codes of paper tapes.

    Args:
        data: The whole file.
        override: Name of the encoding that the user asked for; None to detect it.

    Raises:
        ProgramFileError: `override` is no text encoding.
    """
    if override is not None:
        return _decode_as_told(data, override)
    for bom, codec in _BOMS:
        if data.startswith(bom):
            return _decoded(data.decode(codec, "replace").translate(_DROP_CONTROLS), codec)
    if any(code in data for code in _CONTROLS):
        data = data.translate(None, _CONTROLS)
    for codec in ("ascii", "utf-8"):
        try:
            return Decoded(data.decode(codec), codec, 0)
        except UnicodeDecodeError:
            continue
    codec = _best_codec(_sample(data))
    return _decoded(data.decode(codec, "replace"), codec)


def _decode_as_told(data: bytes, encoding: str) -> Decoded:
    try:
        codec = "utf-8-sig" if codecs.lookup(encoding).name == "utf-8" else encoding
        return _decoded(data.decode(codec, "replace").translate(_DROP_CONTROLS), codec)
    except (LookupError, ValueError) as error:
        raise ProgramFileError("program.unknown-encoding", "--encoding", encoding=encoding) from error


def _decoded(text: str, codec: str) -> Decoded:
    return Decoded(text, codec, text.count("\ufffd"))


def has_byte_order_mark(data: bytes) -> bool:
    """Whether a file begins with a mark that tells its encoding."""
    return any(data.startswith(mark) for mark, _ in _BOMS)


def codec_of(data: bytes) -> str:
    """The codec of text that is neither ASCII nor valid UTF-8 throughout."""
    return _best_codec(_sample(data))


def _sample(data: bytes) -> list[bytes]:
    """The first runs: a byte that is not ASCII, and on while bytes can be the second of a character."""
    runs: list[bytes] = []
    size = 0
    for match in _RUN.finditer(data):
        run = data[match.start() : min(match.end(), match.start() + SAMPLE_BYTES - size)]
        runs.append(run)
        size += len(run)
        if size >= SAMPLE_BYTES:
            break
    return runs


def _best_codec(runs: list[bytes]) -> str:
    scores = {"utf-8": _mean(_utf8_scores(runs))}
    for encoding in (_BIG5, _GB18030, _SHIFT_JIS):
        scores[encoding.codec] = _mean(_double_byte_scores(encoding, runs))
    scores["latin-1"] = _mean(_latin_scores(runs))
    return max(scores, key=lambda codec: scores[codec])


def _mean(scores: Iterator[float]) -> float:
    values = list(scores)
    return sum(values) / len(values) if values else 0.0


def _utf8_scores(runs: list[bytes]) -> Iterator[float]:
    """Valid sequences hardly ever come about by chance: a file with few broken ones is UTF-8 all the same."""
    for run in runs:
        for char in run.decode("utf-8", "replace"):
            if char >= "\x80":
                yield _UNREADABLE if char == "\ufffd" else _OF_THE_FIELD


def _double_byte_scores(encoding: _DoubleByte, runs: list[bytes]) -> Iterator[float]:
    for run in runs:
        text = run.decode(encoding.codec, "replace")
        words: list[str] = _NARROW_KANA.findall(text)
        for word in words:
            yield from [_narrow_kana_score(word)] * len(word)
        for char in _NARROW_KANA.sub("", text):
            if char >= "\x80":
                yield _score(char, encoding)


def _narrow_kana_score(word: str) -> float:
    """Narrow kana are written in words; alone, such a byte is a letter of another alphabet."""
    if _NARROW_WORDS.search(word):
        return _OF_THE_FIELD
    return _FREQUENT if len(word) > 1 else _RARE


def _score(char: str, encoding: _DoubleByte) -> float:
    if char == "\ufffd":
        return _UNREADABLE
    if char in encoding.field:
        return _OF_THE_FIELD
    code = int.from_bytes(char.encode(encoding.codec, "replace"), "big")
    return _FREQUENT if any(low <= code <= high for low, high in encoding.frequent) else _RARE


def _latin_scores(runs: list[bytes]) -> Iterator[float]:
    """Letters with accents stand alone or in pairs (`Größe`); more in a row is no Western word."""
    for run in runs:
        words: list[bytes] = re.findall(rb"[\x80-\xff]+", run)
        for word in words:
            for char in word.decode("latin-1"):
                if char <= "\x9f":
                    yield _UNREADABLE
                elif char in _LATIN:
                    yield _OF_THE_FIELD if len(word) == 1 else _FREQUENT if len(word) == 2 else _RARE
                else:
                    yield _FREQUENT / 2 if char in _LATIN_SIGNS and len(word) == 1 else _RARE
