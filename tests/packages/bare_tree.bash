# What the trials on a bare Debian share; a script sets `tree`, the folder for it, and sources this. As root.

suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}

# step WHAT COMMAND…: a line with the time that it took; the first that fails ends this, with what it printed.
step() {
  local start=$SECONDS what=$1 status
  shift
  # As a program of its own, so that its first failing command ends it; not as a condition, in which none would.
  set +e
  (set -e && "$@") >"$work/log" 2>&1
  status=$?
  set -e
  if ((status == 0)); then
    printf '  %-60s %4d s\n' "$what" $((SECONDS - start))
  else
    printf '  %-60s FAILED\n' "$what"
    cat "$work/log"
    exit 1
  fi
}
inside() {
  chroot "$tree" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"
}
install() { inside apt-get --quiet --yes --no-install-recommends install "$@"; }

make_bare_tree() {
  rm -rf --one-file-system "$tree"
  debootstrap --variant=minbase "$suite" "$tree" "$mirror"
  cp -L /etc/resolv.conf "$tree/etc/resolv.conf"
  mkdir "$tree/work"
}

# takes_the_widest PROGRAM SET…: of the sets of instructions with a library of their own, widest first, the loader takes the
# first that the processor has; its list has lines like 'x86-64-v4 (supported, searched)'.
takes_the_widest() {
  local program=$1 set supported
  shift
  supported=$(inside /lib64/ld-linux-x86-64.so.2 --help | sed -nE 's/^ +(x86-64-v[0-9]) \(supported, searched\)$/\1/p')
  for set in "$@" ''; do
    if [[ -z $set ]] || grep -qx "$set" <<<"$supported"; then break; fi
  done
  echo "the widest: ${set:-none}"
  inside ldd "$program" | grep "${set:+glibc-hwcaps/$set/}libstillpoint"
}

work=$(mktemp -d)
leave() { # so that nobody who removes the tree meets /proc in it
  umount "$tree/proc" 2>/dev/null || true
}
trap 'rm -rf "$work"; leave' EXIT
leave # of a run that was killed
