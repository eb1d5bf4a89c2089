#!/bin/bash
# Health check of a container; exits with 0 if its part of Treadmill is healthy.
#
#   treadmill-health trains     learner: /livez reports progress
#   treadmill-health listens    router: it listens and accepts connections
#   treadmill-health dials      actor or evaluator: its connection is established
#
# Ports: 7447 (hexadecimal 1D17) for the bus, 9464 for metrics.
set -eu

case ${1:-} in
trains)
    exec 3<>/dev/tcp/127.0.0.1/9464
    printf 'GET /livez HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n' >&3
    read -r -t 4 status <&3
    [[ $status == *" 200 "* ]]
    ;;
listens)
    # State 0A is LISTEN; the last eight digits count connections not yet accepted. A frozen process accepts none.
    grep -q ':1D17 00000000:0000 0A 00000000:00000000 ' /proc/net/tcp
    ;;
dials)
    # State 01 is ESTABLISHED. A router closes a silent link, which is then in state 08.
    grep -Eq ' [0-9A-F]+:[0-9A-F]+ [0-9A-F]+:1D17 01 ' /proc/net/tcp
    ;;
*)
    echo 'usage: treadmill-health trains|listens|dials' >&2
    exit 2
    ;;
esac
