"""SARIF 2.1.0, the format in which code hosting sites show findings beside the lines they are about."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from urllib.parse import quote

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.version import __version__

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.cli.diagnostics import Diagnostic, Place

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_ROOT = "%SRCROOT%"


def as_sarif(found: Sequence[Diagnostic], exit_code: int) -> str:
    """One run with all findings; the rules are those that were broken."""
    rules = list({diagnostic.rule: diagnostic for diagnostic in found}.values())
    numbers = {diagnostic.rule: number for number, diagnostic in enumerate(rules)}
    seen: dict[str, int] = {}
    run = {
        "tool": {
            "driver": {
                "name": "polycnc",
                "semanticVersion": __version__,
                "rules": [_rule(diagnostic) for diagnostic in rules],
            }
        },
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": {_ROOT: {"uri": Path.cwd().as_uri() + "/"}},
        "invocations": [{"executionSuccessful": exit_code != 2, "exitCode": exit_code}],
        "results": [_result(diagnostic, numbers[diagnostic.rule], seen) for diagnostic in found],
    }
    return (
        json.dumps({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}, ensure_ascii=False, indent=1)
        + "\n"
    )


def _rule(diagnostic: Diagnostic) -> dict[str, Any]:
    summary = diagnostic.summary or diagnostic.message
    more = " ".join(filter(None, (diagnostic.cause, diagnostic.remedy))) or summary
    return {
        "id": diagnostic.rule,
        "name": diagnostic.code,
        "shortDescription": {"text": summary},
        "fullDescription": {"text": summary},
        "help": {"text": more, "markdown": more},
        "defaultConfiguration": {"level": diagnostic.severity},
        "properties": {"tags": ["cnc", diagnostic.rule.partition("/")[0]]},
    }


def _result(diagnostic: Diagnostic, rule_index: int, seen: dict[str, int]) -> dict[str, Any]:
    result: dict[str, Any] = {
        "ruleId": diagnostic.rule,
        "ruleIndex": rule_index,
        "level": diagnostic.severity,
        "message": {"text": diagnostic.message},
        "locations": [_location(diagnostic.place, diagnostic.source)],
        "partialFingerprints": {"primaryLocationLineHash": _line_hash(diagnostic, seen)},
    }
    if diagnostic.calls:
        steps = [
            *(_location(call) for call in diagnostic.calls),
            _location(diagnostic.place, diagnostic.source),
        ]
        result["codeFlows"] = [{"threadFlows": [{"locations": [{"location": step} for step in steps]}]}]
    return result


def _location(place: Place, source: str = "") -> dict[str, Any]:
    region = {"startLine": max(place.line, 1)}
    if place.column:
        region |= {"startColumn": place.column, "endLine": max(place.line, 1)}
        region["endColumn"] = max(len(source) + 1, place.column + 1)
    return {"physicalLocation": {"artifactLocation": _artifact(place.file), "region": region}}


def _artifact(file: str) -> dict[str, str]:
    """Files inside the working directory relative to it, so that a finding keeps its place."""
    path = Path(file)
    try:
        relative = (path if path.is_absolute() else Path.cwd() / path).relative_to(Path.cwd())
    except ValueError:
        return {"uri": path.resolve().as_uri()}
    return {"uri": quote(os.fsencode(relative.as_posix())), "uriBaseId": _ROOT}


def _line_hash(diagnostic: Diagnostic, seen: dict[str, int]) -> str:
    """Hash of the line's text and its count in this run: it survives lines that are put in above."""
    key = f"{diagnostic.rule}\0{diagnostic.place.file}\0{''.join(diagnostic.source.split())}"
    digest = hashlib.sha256(key.encode(errors="surrogateescape")).hexdigest()[:16]
    seen[digest] = seen.get(digest, 0) + 1
    return f"{digest}:{seen[digest]}"
