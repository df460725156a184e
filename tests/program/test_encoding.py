from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polycnc.program import ProgramFileError, decode

COMMENTS = {
    "cp950": (
        "粗加工 換刀 主軸正轉 切削液開 鑽孔循環 平銑刀 回原點 注意夾具高度 攻牙 外徑粗車 內孔精修 刀長補正 "
        "側面倒角 請先測試 鋁 銅公 檢查尺寸 槽加工 試切 面 刀 孔 滑塊 電極 清角 螺紋 工件翻面 送料 尾座頂緊"
    ),
    "gb18030": (
        "粗加工 换刀 主轴正转 切削液开 钻孔循环 平铣刀 回原点 注意夹具高度 攻丝 外圆粗车 内孔精镗 刀长补偿 "
        "侧面倒角 请先测试 铝 铜公 检查尺寸 槽加工 试切 面 刀 孔 滑块 电极 清角 螺纹 工件翻面 送料 尾座顶紧"
    ),
    "cp932": (
        "荒加工 仕上げ 工具交換 主軸正転 クーラントON 穴あけ ドリル エンドミル プログラム終了 原点復帰 "
        "治具に注意 タップ 外径荒削り センタードリル 山田太郎 面取り 溝加工 旋盤 ねじ切り 突切り "
        "ﾄﾞﾘﾙ ｴﾝﾄﾞﾐﾙ ｱﾗｶﾞｳ ｼｱｹﾞ ﾒﾝﾄﾘ"
    ),
    "latin-1": (
        "Fräser Größe Außendurchmesser Rückzug Nullpunkt_prüfen SCHRÄG 45°_Fase 20°C ±0.01 Ø8 Ébauche "
        "perçage diámetro posición pièce_n°3 contrôle M8×1.25 Kühlmittel à_gauche µm für Fläche Señal"
    ),
}
ONE_BY_ONE = [(codec, comment) for codec, text in COMMENTS.items() for comment in text.split()]


@pytest.mark.parametrize(("codec", "comment"), ONE_BY_ONE, ids=[f"{c}-{t}" for c, t in ONE_BY_ONE])
def test_one_short_comment_of_the_shop_is_enough_to_tell_the_encoding(codec: str, comment: str) -> None:
    text = f"O0001 ({comment})\nG0 X0\n"
    assert decode(text.encode(codec)).text == text


@pytest.mark.parametrize(("codec", "comments"), COMMENTS.items())
@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r", "\n\r\r"])
def test_a_whole_program_keeps_every_character(codec: str, comments: str, line_end: str) -> None:
    text = line_end.join(f"G1 X{n} ({comment})" for n, comment in enumerate(comments.split()))
    decoded = decode(text.encode(codec))
    assert (decoded.text, decoded.encoding, decoded.replaced) == (text, codec, 0)


@pytest.mark.parametrize(
    ("codec", "found"),
    [("ascii", "ascii"), ("utf-8-sig", "utf-8-sig"), ("utf-16", "utf-16"), ("utf-8", "ascii")],
)
def test_plain_text_is_told_by_its_mark_or_by_being_ascii(codec: str, found: str) -> None:
    decoded = decode("%\nO0001\nM30\n%\n".encode(codec))
    assert (decoded.text, decoded.encoding) == ("%\nO0001\nM30\n%\n", found)


def test_utf8_is_preferred_where_it_is_valid() -> None:
    assert decode("(粗加工 Größe ±0.1)".encode()).encoding == "utf-8"


def test_a_broken_byte_in_a_utf8_file_costs_one_character_only() -> None:
    data = "(粗加工)\n(精加工)\n(鑽孔循環)\n".encode() + b"(\xe7)\nM30\n"
    decoded = decode(data)
    assert (decoded.encoding, decoded.replaced) == ("utf-8", 1)
    assert decoded.text.endswith("(\ufffd)\nM30\n")


def test_bytes_that_the_encoding_cannot_read_leave_the_blocks_around_them_alone() -> None:
    data = "G0 X1 (粗加工 銑平面)\n".encode("cp950") + b"G0 X2 (\xff\xff)\nG0 X3 (\xa4)\n"
    decoded = decode(data)
    assert decoded.encoding == "cp950"
    assert decoded.text.split("\n")[1:] == ["G0 X2 (\ufffd\ufffd)", "G0 X3 (\ufffd)", ""]
    assert decoded.replaced == 3


def test_the_user_decides_against_detection() -> None:
    text = "(Обработка)"
    data = text.encode("cp1251")
    assert decode(data, "cp1251").text == text
    assert decode(data).text != text


def test_a_byte_order_mark_is_no_character_even_if_the_user_names_utf8() -> None:
    assert decode("O1".encode("utf-8-sig"), "UTF8").text == "O1"


@pytest.mark.parametrize("name", ["klingon", "hex", "rot13", "idna", "undefined", "", "utf\0", "ü"])
def test_an_encoding_that_is_none_is_an_error_value(name: str) -> None:
    with pytest.raises(ProgramFileError) as error:
        decode(b"\xff.", name)
    assert error.value.message == "program.unknown-encoding"


@pytest.mark.parametrize("override", [None, "latin-1"])
def test_blank_tape_and_reader_codes_carry_nothing(override: str | None) -> None:
    data = b"\0\0\0\x11%\r\nO1\r\n\x7fM\x7f30\r\n%\x13\x14\0\0\x1a"
    assert decode(data, override).text == "%\r\nO1\r\nM30\r\n%"


@given(
    st.binary(),
    st.sampled_from([None, "big5", "gb18030", "shift-jis", "latin-1", "utf-8", "ascii", "utf-16"]),
)
def test_arbitrary_bytes_always_become_text(data: bytes, override: str | None) -> None:
    decoded = decode(data, override)
    assert decoded.replaced == decoded.text.count("\ufffd")


@given(st.text(st.characters(codec="utf-8", exclude_characters="\0\x11\x12\x13\x14\x1a\x7f\ufeff\ufffd")))
def test_utf8_comes_back_as_it_was(text: str) -> None:
    assert decode(text.encode()).text == text


@given(st.lists(st.binary(min_size=1).filter(lambda data: not data.isascii()), min_size=1, max_size=5))
def test_unreadable_comments_never_swallow_their_end_or_the_next_block(comments: list[bytes]) -> None:
    bodies = [comment.translate(None, b"\r\n") for comment in comments]
    lines = decode(b"M0\n" + b"".join(b"(" + body + b")\nG1 X2 F100\n" for body in bodies)).text.split("\n")
    assert len(lines) == 2 * len(bodies) + 2
    assert all(line.startswith("(") and line.endswith(")") for line in lines[1:-1:2])
    assert lines[2::2] == ["G1 X2 F100"] * len(bodies)
