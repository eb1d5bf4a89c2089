#!/bin/bash
# Tells whether a part of Treadmill in this container is well, by its exit code.
#
#   treadmill-health trains     a learner: its own page says that training goes on
#   treadmill-health listens    a router: it listens, and nobody who dialled still waits to be let in
#   treadmill-health dials      an actor or an evaluator: its link stands
#
# Ports are those of the files beside this one: 7447 for the bus (hexadecimal 1D17), 9464 for metrics.
set -eu

case ${1:-} in
trains)
    exec 3<>/dev/tcp/127.0.0.1/9464
    printf 'GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n' >&3
    read -r -t 4 status <&3
    [[ $status == *" 200 "* ]]
    ;;
listens)
    # State 0A is listening; the last eight zeros count those who wait. A process that stands still keeps its port open
    # but lets nobody in.
    grep -q ':1D17 00000000:0000 0A 00000000:00000000 ' /proc/net/tcp
    ;;
dials)
    # State 01 is established; a router that heard nothing for a while has closed the link, which is state 08.
    grep -Eq ' [0-9A-F]+:[0-9A-F]+ [0-9A-F]+:1D17 01 ' /proc/net/tcp
    ;;
*)
    echo 'treadmill-health: say trains, listens or dials' >&2
    exit 2
    ;;
esac
