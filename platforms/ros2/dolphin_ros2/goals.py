"""Goals of actions: their identity, and how their results are judged."""

from __future__ import annotations

import uuid
from typing import Any, Mapping, Optional

import dolphin
from dolphin import templates

from .configuration import PlanRule

UNKNOWN, ACCEPTED, EXECUTING, CANCELING, SUCCEEDED, CANCELED, ABORTED = range(7)
"""The states of action_msgs/msg/GoalStatus."""
ACTIVE = frozenset({ACCEPTED, EXECUTING, CANCELING})
OVER = frozenset({SUCCEEDED, CANCELED, ABORTED})

ERROR_NONE, ERROR_REJECTED, ERROR_UNKNOWN_GOAL_ID, ERROR_GOAL_TERMINATED = range(4)
"""The replies of action_msgs/srv/CancelGoal."""

_NAMESPACE = uuid.uuid5(uuid.NAMESPACE_DNS, "dolphin-ros2")


def goal_id(robot: str, request: str, number: int = 0) -> uuid.UUID:
    """The identity of a goal of a request: of the only one, or of one of several. It follows from the request, so that
    an adapter which is started again, by the same console or by another one, asks the robot about the same goal.

    >>> goal_id("carrier-1", "k3q9x2f1-4")
    UUID('0c389aa5-cb63-55f9-b061-0eab7a6e95ca')
    """
    return uuid.uuid5(_NAMESPACE, f"{robot}\n{request}" + (f"\n{number}" if number else ""))


def judge(rule: PlanRule, status: int, result: Any) -> None:
    """Returns if a goal with this status and result is done; raises `Failed` or `Unknown` otherwise."""
    if status == SUCCEEDED:
        if not _is_success(rule, result):
            why = _reason(rule, result) or f"its action {rule.interface} ends with {_code(rule, result)}"
            raise dolphin.Failed(why)
    elif status == ABORTED:
        raise dolphin.Failed(_reason(rule, result) or f"its action {rule.interface} was aborted")
    elif status == CANCELED:
        raise dolphin.Failed(f"its action {rule.interface} was cancelled by another client")
    else:
        raise dolphin.Unknown(f"its action {rule.interface} no longer knows the goal")


def judge_reply(rule: PlanRule, response: Any) -> None:
    """Returns if the reply of a service means success; raises `Failed` otherwise. Without a rule that is decided by the
    fields `success` and `message`, if there are any."""
    if not _is_success(rule, response):
        why = _reason(rule, response) or f"its service {rule.interface} ends with {_code(rule, response)}"
        raise dolphin.Failed(why)
    if rule.result.field is None and getattr(response, "success", True) is False:
        why = _reason(rule, response) or _line(getattr(response, "message", ""))
        raise dolphin.Failed(why or f"its service {rule.interface} reports a failure")


def _is_success(rule: PlanRule, result: Any) -> bool:
    if rule.result.field is None:
        return True
    value = rule.result.field.read(result)
    return any(_same(value, wanted) for wanted in rule.result.done)


def _reason(rule: PlanRule, result: Any) -> str:
    """The configured words for the result's value, and its own message. May be empty."""
    how = rule.result
    words = "" if how.field is None else how.words.get(_text(how.field.read(result)), "")
    message = "" if how.message is None else _line(how.message.read(result))
    return ": ".join(reason for reason in (words, message) if reason)


def _code(rule: PlanRule, result: Any) -> str:
    field = rule.result.field
    return "" if field is None else f"{field.text} {_text(field.read(result))}"


def _line(text: Any) -> str:
    return " ".join(str(text).split()).rstrip(".")


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _same(value: Any, wanted: Any) -> bool:
    """Equality of numbers, texts and truths; `true` and 1 differ."""
    return value == wanted and isinstance(value, bool) == isinstance(wanted, bool)


def share(rule: PlanRule, parameters: Mapping[str, Any], feedback: Any) -> Optional[float]:
    """The share of the plan that is done, by its feedback."""
    if rule.progress is None or rule.progress.field is None:
        return None
    value = rule.progress.field.read(feedback)
    amount = len(value) if isinstance(value, (list, tuple)) else value
    try:
        return float(amount) / float(templates.substitute(rule.progress.of, parameters))
    except (TypeError, ValueError, ZeroDivisionError):
        return None


def remaining(rule: PlanRule, feedback: Any) -> Optional[float]:
    """The seconds that remain, by its feedback."""
    if rule.progress is None or rule.progress.remaining is None:
        return None
    value = rule.progress.remaining.read(feedback)
    return float(value) if isinstance(value, (int, float)) else None
