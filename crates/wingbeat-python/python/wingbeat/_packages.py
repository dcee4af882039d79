"""Packages of others that only some of this needs."""

from __future__ import annotations

from importlib import import_module

from wingbeat.errors import PackageError


def needs(package: str, extra: str, key: str) -> None:
    """Imports what ``key`` needs and the extra ``extra`` of the package brings.

    Raises :class:`wingbeat.PackageError` if it cannot be imported.
    """
    try:
        import_module(package)
    except ImportError as e:
        remedy = f"install the extra `{extra}` of the package (docs/python.md)"
        raise PackageError(f"{key} needs {package.split('.')[0]}: {e}", key=key, remedy=remedy) from e
