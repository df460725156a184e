"""What SARIF 2.1.0 asks of the objects that polycnc writes: the names it knows, and their types."""

from __future__ import annotations

from typing import Any


def _object(required: tuple[str, ...] = (), **properties: Any) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": list(required),
        "additionalProperties": False,
    }


def _list(items: dict[str, Any], at_least: int = 0) -> dict[str, Any]:
    return {"type": "array", "items": items, "minItems": at_least}


TEXT = {"type": "string", "minLength": 1}
FROM_1 = {"type": "integer", "minimum": 1}
MESSAGE = _object(("text",), text=TEXT, markdown=TEXT)
LEVEL = {"enum": ["none", "note", "warning", "error"]}
ARTIFACT = _object(("uri",), uri={"type": "string", "format": "uri-reference"}, uriBaseId=TEXT)
REGION = _object(("startLine",), startLine=FROM_1, startColumn=FROM_1, endLine=FROM_1, endColumn=FROM_1)
PHYSICAL = _object(("artifactLocation",), artifactLocation=ARTIFACT, region=REGION)
LOCATION = _object(physicalLocation=PHYSICAL, message=MESSAGE)
RULE = _object(
    ("id",),
    id=TEXT,
    name=TEXT,
    shortDescription=MESSAGE,
    fullDescription=MESSAGE,
    help=MESSAGE,
    helpUri=TEXT,
    defaultConfiguration=_object(level=LEVEL),
    properties={
        "type": "object",
        "properties": {"tags": {**_list(TEXT), "uniqueItems": True, "maxItems": 20}},
    },
)
DRIVER = _object(
    ("name",),
    name=TEXT,
    semanticVersion={"type": "string", "pattern": r"^\d+\.\d+\.\d+"},
    informationUri={"type": "string", "format": "uri"},
    rules=_list(RULE),
)
CODE_FLOW = _object(
    ("threadFlows",),
    threadFlows=_list(_object(("locations",), locations=_list(_object(location=LOCATION), 1)), 1),
)
RESULT = _object(
    ("message",),
    ruleId=TEXT,
    ruleIndex={"type": "integer", "minimum": -1},
    level=LEVEL,
    message=MESSAGE,
    locations=_list(LOCATION),
    partialFingerprints={"type": "object", "additionalProperties": {"type": "string"}},
    codeFlows=_list(CODE_FLOW),
)
RUN = _object(
    ("tool",),
    tool=_object(("driver",), driver=DRIVER),
    columnKind={"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
    originalUriBaseIds={
        "type": "object",
        "additionalProperties": _object(uri={"type": "string", "pattern": "/$"}),
    },
    invocations=_list(
        _object(
            ("executionSuccessful",), executionSuccessful={"type": "boolean"}, exitCode={"type": "integer"}
        )
    ),
    results=_list(RESULT),
)
SARIF = {
    **_object(
        ("version", "runs"),
        **{"$schema": {"type": "string", "format": "uri"}},
        version={"const": "2.1.0"},
        runs=_list(RUN),
    ),
    "$schema": "https://json-schema.org/draft/2020-12/schema",
}
