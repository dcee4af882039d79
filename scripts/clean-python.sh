#!/usr/bin/env bash
# The wheel where nobody has Rust: `scripts/clean-python.sh WHEEL` gathers it and what it depends on, installs them into a
# fresh virtual environment from these files alone, and runs the first notebook there, without cargo and without a network.
set -euo pipefail
wheel="$(realpath "$1")"
page="$(realpath "$(dirname "$0")/../docs/notebooks/five-minutes.md")"
runner="$(realpath "$(dirname "$0")/run-notebook.py")"
clean="$(mktemp -d)"
trap 'rm -rf "$clean"' EXIT
python3 -m venv "$clean/env"
needs=("$wheel[data,plot]" jupytext nbclient ipykernel)
"$clean/env/bin/pip" download -q --only-binary :all: --dest "$clean/files" "${needs[@]}"
"$clean/env/bin/pip" install -q --no-index --find-links "$clean/files" "${needs[@]}"
cp "$page" "$clean"
offline=()
if unshare -rn true 2>/dev/null; then
  offline=(unshare -rn)  # no network at all but the loopback, over which notebooks talk to their kernel
else
  echo "No network namespaces here: installed without a network, run with one."
fi
PATH="$clean/env/bin:/usr/bin:/bin" "${offline[@]}" bash -c '
  set -e
  ! command -v cargo >/dev/null || { echo "cargo is here"; exit 1; }
  python -c "
import fcntl, socket, struct
s = socket.socket()
flags = struct.pack(\"16sh\", b\"lo\", 1)  # the loopback is up: SIOCSIFFLAGS with IFF_UP
fcntl.ioctl(s, 0x8914, flags)
" 2>/dev/null || true
  python "$1" "$2"' run "$runner" "$clean/five-minutes.md"
