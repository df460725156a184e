"""`polycnc parameters`: the parameters of a control by number, with meaning and value; set in a setup."""

from __future__ import annotations

from polycnc.cli import options
from polycnc.cli.console import fail, say
from polycnc.cli.declaration import Argument, Commands, Path
from polycnc.deferred.typing import TYPE_CHECKING, Annotated
from polycnc.messages import text
from polycnc.messages.catalogue import listed

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from polycnc.control.parameters import KnownParameter
    from polycnc.machine.setup.values import ParameterKey, Parameters

commands = Commands("help.parameters")


@commands.command("help.parameters.list", "list")
def list_parameters(
    control: options.Control = None, setup: options.Setup = None, _lang: options.Lang = None
) -> int:
    """One parameter a line: number, value, meaning; what the setup names beside these is told on standard error."""
    from polycnc.cli.told import tell_unheeded
    from polycnc.control import registry

    known = _known(control)
    if isinstance(known, int):
        return known
    values = _values(setup)
    for parameter in known:
        shown = " ".join(_shown(parameter, values))
        say(f"{parameter.numbers:9} {shown:12} {_meaning(parameter)}")
    tell_unheeded(registry.control(str(control)), values)
    return 0


@commands.command("help.parameters.show", "show")
def show_parameter(
    number: Annotated[str, Argument(metavar="NUMBER")],
    control: options.Control = None,
    setup: options.Setup = None,
    _lang: options.Lang = None,
) -> int:
    """A parameter, or all bits of a number."""
    known = _known(control)
    if isinstance(known, int):
        return known
    wanted = number.strip().upper()
    found = [
        p
        for p in known
        if wanted in (p.number, p.number.partition("#")[0], p.number.zfill(len(wanted)), p.mnemonic)
        or (p.count > 1 and wanted in {str(key.id) for key in p.keys})
    ]
    if not found:
        return fail(text("parameters.unknown", control=control, number=number), 2)
    values = _values(setup)
    for parameter in found:
        say(f"{parameter.numbers} {_meaning(parameter)}")
        if parameter.delivered is not None:
            say(f"  {text('parameters.delivered')}: {_told(parameter.delivered)}")
        given = list(_given(parameter, values))
        if given:
            say(f"  {text('parameters.in-setup')}: {' '.join(given)}")
    return 0


@commands.command("help.parameters.set", "set")
def set_parameters(
    assignments: Annotated[list[str], Argument(metavar="NUMBER=VALUE…")],
    setup: options.Setup = Path("setup.yaml"),
    control: options.Control = None,
    _lang: options.Lang = None,
) -> int:
    """Write parameters into a setup; none of them if one is wrong."""
    from polycnc.cli.output import write_whole
    from polycnc.machine.setup import edit

    known = _known(control)
    if isinstance(known, int):
        return known
    path = setup or Path("setup.yaml")
    if not edit.is_writable(path):
        return fail(text("data.setup-form", setup=path), 2)
    values: dict[str, float | str] = {}
    for word in assignments:
        name, equals, value = (part.strip() for part in word.partition("="))
        reason = _refused(word, name, value, known) if equals else text("parameters.form", word=word)
        if reason:
            return fail(reason, 2)
        number = _number(value)
        values[name] = value if number is None else int(number) if number.is_integer() else number
    document = edit.read_document(path)
    edit.merge(document, {"parameters": values})
    write_whole(path, edit.document_text(document, str(path)))
    return 0


def _refused(word: str, name: str, value: str, known: Iterable[KnownParameter]) -> str:
    """Why an assignment cannot be taken over; empty where it can."""
    from polycnc.machine.setup.values import parameter_key

    try:
        key = parameter_key(name)
    except ValueError:
        return text("parameters.form", word=word)
    parameter = next((each for each in known if _is_meant(each, key)), None)
    if parameter is None:
        return text("parameters.unknown", control="", number=name).removeprefix(": ")
    number = _number(value)
    if number is None:
        return (
            "" if isinstance(parameter.delivered, str) else text("parameters.value", word=word, value=value)
        )
    if not abs(number) < float("inf"):
        return text("parameters.value", word=word, value=value)
    return text("parameters.bit", word=word) if key.bit is not None and number not in (0.0, 1.0) else ""


def _is_meant(parameter: KnownParameter, key: ParameterKey) -> bool:
    """Whether a setup means a parameter, or an element or a bit of it, by this key."""
    return key.id in parameter.ids and (key.bit == parameter.key.bit or parameter.has_bits)


def _number(value: str) -> float | None:
    """A word as a number; None for a text."""
    try:
        return float(value)
    except ValueError:
        return None


def _known(control: str | None) -> tuple[KnownParameter, ...] | int:
    """The list of a control, or the exit status after saying why there is none."""
    from polycnc.control import registry
    from polycnc.control.parameters import known_parameters

    if control is None or control not in registry.ids():
        known = listed(registry.ids())
        message = "session.control-wanted" if control is None else "session.control-unknown"
        return fail(text(message, control=control, known=known), 2)
    return known_parameters(registry.control(control))


def _values(setup: Path | None) -> Parameters:
    from polycnc.machine import Parameters, load_setup

    return Parameters() if setup is None else load_setup(setup).parameters


def _meaning(parameter: KnownParameter) -> str:
    from polycnc.control.parameters import NOT_YET
    from polycnc.messages.catalogue import language

    unit = f" [{parameter.unit}]" if parameter.unit else ""
    meaning = parameter.texts[language()] + unit
    if parameter.read == NOT_YET:
        meaning = text("parameters.kept", meaning=meaning)
    name = parameter.mnemonic
    return text("parameters.named", name=name, meaning=meaning) if name else meaning


def _shown(parameter: KnownParameter, values: Parameters) -> Iterator[str]:
    """The values of the setup, else the delivered one."""
    given = list(_given(parameter, values))
    if given:
        yield from given
    else:
        yield "-" if parameter.delivered is None else _told(parameter.delivered)


def _told(value: float | str) -> str:
    """A delivered value."""
    return f"{value:g}" if not isinstance(value, str) else value or "-"


def _given(parameter: KnownParameter, values: Parameters) -> Iterator[str]:
    """The values that a setup gives, with what they are of in front: number of several, bit, element, axis."""
    wanted = parameter.key
    for key, value in values.items():
        if _is_meant(parameter, key):
            of = _place(key, parameter)
            yield f"{of}={value}" if of else str(value)
        elif key.id == wanted.id and key.bit is None and wanted.bit is not None and isinstance(value, int):
            yield str(value >> wanted.bit & 1)


def _place(key: ParameterKey, parameter: KnownParameter) -> str:
    """Which one of a parameter's values a key names; empty where it has but one."""
    number = str(key.id) if parameter.count > 1 else ""
    bit = f"#{key.bit}" if key.bit is not None and parameter.has_bits else ""
    element = "" if key.element is None else str(key.element).strip("()").replace(" ", "")
    return number + bit + (f"[{element}]" if element else "") + (key.axis or "")
