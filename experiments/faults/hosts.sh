#!/bin/sh
# Creates hosts on one machine: network namespaces, linked to a bridge in its own namespace. Needs root and iproute2. Changes
# nothing outside the namespaces.
#
# Usage: hosts.sh up [PREFIX] | hosts.sh down [PREFIX]
#
# To run a program on a host: ip netns exec PREFIX-HOST PROGRAM. PREFIX defaults to `tm`. The variable HOSTS replaces the hosts.
set -eu
prefix=${2:-tm}
hosts=${HOSTS:-"learner=10.77.0.1 router=10.77.0.2 actor1=10.77.0.11 actor2=10.77.0.12 observer=10.77.0.20"}

down() {
    for host in $hosts; do ip netns delete "$prefix-${host%%=*}" 2>/dev/null || true; done
    ip netns delete "$prefix-net" 2>/dev/null || true
}

up() {
    ip netns add "$prefix-net"
    # Without snooping, the bridge forwards multicast to every host, as a small switch does.
    ip -n "$prefix-net" link add bridge type bridge mcast_snooping 0
    ip -n "$prefix-net" link set bridge up
    for host in $hosts; do
        name=${host%%=*}
        ip netns add "$prefix-$name"
        ip -n "$prefix-net" link add "$name" type veth peer name eth0 netns "$prefix-$name"
        ip -n "$prefix-net" link set "$name" master bridge up
        ip -n "$prefix-$name" address add "${host#*=}/24" dev eth0
        ip -n "$prefix-$name" link set lo up
        ip -n "$prefix-$name" link set eth0 up
        ip -n "$prefix-$name" route add 224.0.0.0/4 dev eth0
    done
}

case "${1:-}" in
    up) down; up ;;
    down) down ;;
    --help) echo "usage: hosts.sh up|down [PREFIX]" ;;
    *) echo "usage: hosts.sh up|down [PREFIX]" >&2; exit 2 ;;
esac
