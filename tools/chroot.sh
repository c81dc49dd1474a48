#!/usr/bin/env bash
# A bare Debian 12 in a chroot. Sourced by tools/test-bare and tools/test-packages after they define fail(); needs root,
# debootstrap and the network. MIRROR names another Debian mirror.

# make_bare [DIR]: sets `bare`, DIR or a temporary folder that goes away with the script, and installs Debian there.
make_bare() {
    ((EUID == 0)) || fail "only root can make a chroot"
    command -v debootstrap >/dev/null || fail "debootstrap is missing"
    if [[ -n ${1-} ]]; then
        [[ ! -e $1 ]] || fail "$1 exists; a bare machine starts from nothing"
        bare=$1
    else
        bare=$(mktemp -d)
        trap 'rm -rf --one-file-system "$bare"' EXIT
    fi
    mkdir -p "$bare" && chmod 755 "$bare" # apt's own user has to get in
    debootstrap --variant=minbase bookworm "$bare" "${MIRROR:-http://deb.debian.org/debian}"

    # The host's way to the network: proxies, and the certificates that they may need (pip has no others on a bare machine).
    network=()
    local name certificates=/etc/ssl/certs/ca-certificates.crt
    for name in http_proxy https_proxy no_proxy; do
        [[ -z ${!name-} ]] || network+=("$name=${!name}")
    done
    if [[ -f $certificates ]]; then
        cp "$certificates" "$bare/root/certificates.crt"
        network+=(PIP_CERT=/root/certificates.crt)
    fi
}

# Runs a command in the chroot. Its mounts and processes live in namespaces of their own and end with it.
# shellcheck disable=SC2016  # the inner shell expands these
in_bare() {
    unshare --mount --pid --fork --kill-child bash -euc '
        mount --rbind /dev "$0/dev"; mount -t proc proc "$0/proc"; mount -t sysfs sysfs "$0/sys"
        exec chroot "$0" "$@"' "$bare" \
        /usr/bin/env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        "${network[@]}" "$@" </dev/null
}
