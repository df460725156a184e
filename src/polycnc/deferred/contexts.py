"""`contextmanager` and its likes as those of `contextlib`, without the classes that the library makes for every start.

With the library's the installed command takes 5 % more instructions for a short run (`python -m` loads it anyhow). What
nothing here uses is left out: context managers as decorators, those of coroutines, and of an `ExitStack` all but
`enter_context` and `callback`.
"""

from __future__ import annotations

from functools import wraps

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from contextlib import ExitStack, contextmanager, nullcontext, suppress
else:

    def contextmanager(function):
        """A generator that yields once as a context; see `contextlib.contextmanager`."""

        @wraps(function)
        def made(*args, **named):
            return _Generated(function(*args, **named))

        return made

    class _Generated:
        """Runs a generator to its `yield` and, when the context is left, from there to its end."""

        def __init__(self, generator):
            self._generator = generator

        def __enter__(self):
            try:
                return next(self._generator)
            except StopIteration:
                raise RuntimeError("generator didn't yield") from None

        def __exit__(self, kind, error, trace):
            try:
                if kind is None:
                    next(self._generator)
                else:
                    self._generator.throw(error)
            except StopIteration as end:
                return end is not error and kind is not None
            except BaseException as raised:
                # A generator cannot let a `StopIteration` through: Python makes another error of it.
                through = raised.__cause__ if isinstance(error, StopIteration) else raised
                if error is None or through is not error:
                    raise
                error.__traceback__ = trace
                return False
            self._generator.close()
            raise RuntimeError(
                "generator didn't stop" if kind is None else "generator didn't stop after throw()"
            )

    class suppress:  # noqa: N801 - the library calls it so
        """Errors of these kinds end what is within, and are no errors behind it; see `contextlib.suppress`."""

        def __init__(self, *kinds):
            self._kinds = kinds

        def __enter__(self):
            return None

        def __exit__(self, kind, error, trace):
            return kind is not None and issubclass(kind, self._kinds)

    class nullcontext:  # noqa: N801 - the library calls it so
        """Does nothing; see `contextlib.nullcontext`."""

        def __init__(self, result=None):
            self._result = result

        def __enter__(self):
            return self._result

        def __exit__(self, kind, error, trace):
            return None

    class ExitStack:
        """Contexts that are entered one by one and left in reverse; see `contextlib.ExitStack`."""

        def __init__(self):
            self._leaving = []

        def __enter__(self):
            return self

        def enter_context(self, context):
            """Enter a context that is left with this one."""
            entered = context.__enter__()
            self._leaving.append(context.__exit__)
            return entered

        def callback(self, function, /, *args, **named):
            """Call a function when this context is left."""

            def leave(*_):
                function(*args, **named)

            self._leaving.append(leave)

        def __exit__(self, kind, error, trace):
            now = error
            while self._leaving:
                leave = self._leaving.pop()
                try:
                    if leave(*((None, None, None) if now is None else (type(now), now, now.__traceback__))):
                        now = None
                except BaseException as raised:  # noqa: BLE001 - it goes on to the others, and is raised behind them
                    if raised is not now:
                        raised.__context__ = now
                    now = raised
            if now is not None and now is not error:
                raise now
            return now is not error


__all__ = ["ExitStack", "contextmanager", "nullcontext", "suppress"]
