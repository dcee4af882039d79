"""Packages of others that only some of this needs."""

from __future__ import annotations

from importlib import import_module

from wingbeat.errors import PackageError


def needs(package: str, extra: str, key: str) -> None:
    """Imports what ``key`` needs and ``pip install wingbeat[extra]`` brings.

    Raises :class:`wingbeat.PackageError` if it cannot be imported.
    """
    try:
        import_module(package)
    except ImportError as e:
        remedy = f"pip install wingbeat[{extra}]"
        raise PackageError(f"{key} needs {package.split('.')[0]}: {e}", key=key, remedy=remedy) from e
