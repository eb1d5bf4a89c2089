#!/usr/bin/env bash
# Runs the stack of docker-compose.yml on a Docker Engine, with a binary that is built already: trains over mutual TLS,
# scales, kills, stops and resumes, and asks an independent client who may do what.
#
#   sudo deploy/test.sh [target/release/treadmill]
#
# Where no engine answers, one is started for the time of the test, in a network namespace of its own, so that neither
# addresses nor firewall rules of this machine change. Needs docker, docker-compose (or Compose v2), dockerd, debootstrap,
# iptables, iproute2, nsenter and unshare, openssl; for the base image a Debian mirror where no registry has it.
#
# TREADMILL_PYTHON       a Python with eclipse-zenoh and, for the dashboard, nothing else; python3 where it is not given
# TREADMILL_PROMETHEUS   a Prometheus to ask the dashboard's questions; `prometheus` where it is not given
# TREADMILL_STRICT       not empty: what cannot be tested is a failure
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
binary=$(realpath "${1:-$here/../target/release/treadmill}")
[ -x "$binary" ] || { echo "there is no binary \`$binary\`; build it first" >&2; exit 2; }
exec </dev/null

started=$SECONDS
say() { printf '%4d s  %s\n' $((SECONDS - started)) "$*"; }
fail() {
    printf '\n!!! %s\n' "$*" >&2
    exit 1
}
missing() {
    [ -z "${TREADMILL_STRICT:-}" ] || fail "$*"
    printf '\n!!! %s\n' "$*" >&2
}

work=$(mktemp -d)
engine=
project=treadmill-test-$$
scraper=
compose() { COMPOSE_PROJECT_NAME=$project "${composer[@]}" -f "$here/docker-compose.yml" "$@"; }
cleanup() {
    code=$?
    set +e
    if [ "$code" != 0 ] && [ -n "${composer:-}" ]; then
        compose ps
        compose logs --no-color --tail 5 | cut -c1-300
    fi >&2
    [ -z "$scraper" ] || kill "$scraper"
    [ -z "${composer:-}" ] || compose down -v --remove-orphans -t 1 >/dev/null 2>&1
    if [ -n "$engine" ]; then
        kill "$engine"
        wait "$engine"
        # Containers that outlived it, mounts that outlived those.
        awk -v under="$work/" 'index($2, under) == 1 { print $2 }' /proc/mounts | sort -r | xargs -r umount -l
    fi 2>/dev/null
    rm -rf "$work"
    exit "$code"
}
trap cleanup EXIT

# Looks again and again until the command succeeds; the limit is one that only a broken stack reaches.
await() {
    local what=$1 until=$((SECONDS + 120))
    shift
    until "$@"; do
        [ "$SECONDS" -lt "$until" ] || fail "waited in vain: $what"
        sleep 0.5
    done
}

# --- an engine, and a way into its network ------------------------------------------------------------------------------
enter=()
if ! docker info >/dev/null 2>&1; then
    [ "$(id -u)" = 0 ] || fail 'no Docker Engine answers, and only root can start one'
    export DOCKER_HOST=unix://$work/docker.sock
    unshare --net dockerd --host "$DOCKER_HOST" --data-root "$work/data" --exec-root "$work/exec" \
        --pidfile "$work/pid" >"$work/dockerd.log" 2>&1 &
    engine=$!
    answers() {
        kill -0 "$engine" 2>/dev/null || { tail -5 "$work/dockerd.log" >&2; fail 'dockerd ended'; }
        docker info >/dev/null 2>&1
    }
    await 'a Docker Engine that answers' answers
    enter=(nsenter "--net=/proc/$engine/ns/net")
    "${enter[@]}" ip link set lo up
fi
if docker compose version >/dev/null 2>&1; then
    composer=(docker compose)
else
    composer=(docker-compose)
fi
say "engine $(docker version --format '{{.Server.Version}}'), $("${composer[@]}" version --short)"

# --- the image: the Dockerfile's last stage around the binary ----------------------------------------------------------
base=$(sed -n 's/^FROM \(debian:[^ ]*\)$/\1/p' "$here/Dockerfile")
docker image inspect "$base" >/dev/null 2>&1 || docker pull -q "$base" 2>/dev/null || "$here/base-images.sh" runtime
mkdir -p "$work/image/deploy"
cp "$binary" "$work/image/treadmill"
cp "$here"/*.sh "$work/image/deploy"
sed -n '/^FROM debian:/,$p' "$here/Dockerfile" |
    sed 's|COPY --from=build /src/target/release/treadmill|COPY treadmill|' >"$work/image/Dockerfile"
DOCKER_BUILDKIT=0 docker build -q -t treadmill:test "$work/image" >"$work/build.log" 2>&1 ||
    { cat "$work/build.log" >&2; fail 'the image cannot be built'; }
docker run --rm --network none treadmill:test --version >/dev/null ||
    fail "$binary does not run on $base; build it on that release"
say "image of $(docker image inspect -f '{{.Size}}' treadmill:test) bytes"

# --- up --------------------------------------------------------------------------------------------------------------------
export TREADMILL_IMAGE=treadmill:test TREADMILL_PRESET=smoke TREADMILL_STEPS=100000000 TREADMILL_ACTOR_ENVS=4 \
    TREADMILL_PORT=0 TREADMILL_ACTORS=2 TREADMILL_SET='eval.every_steps=20000 eval.episodes=2' TREADMILL_LOG=
compose up -d --no-build --scale actor=2 2>"$work/up.log" || { cat "$work/up.log" >&2; fail 'up'; }
# None of these pipes ends before it has read everything: whoever writes into a closed one fails.
id() { compose ps -q "$1" 2>/dev/null | sed -n 1p; }
learner=$(id learner) router=$(id router)

# The newest value of a metric, as a whole number.
value() {
    docker exec "$learner" grep -F "\"tag\":\"$1\"" /runs/smoke/metrics.jsonl 2>/dev/null | tail -n 1 |
        sed -n 's/.*"value":\(-\{0,1\}[0-9]*\).*/\1/p'
}
steps() { value time/total_timesteps; }
trains_beyond() { now=$(steps) && [ "${now:-0}" -gt "$1" ]; }
alive_is() { [ "$(value actors/alive)" = "$1" ]; }
known() { [ -n "$(value "$1")" ]; }
health_is() { [ "$(docker inspect -f '{{.State.Health.Status}}' "$1")" = "$2" ]; }

await 'updates' trains_beyond 0
await 'two actors' alive_is 2
await 'evaluations' known eval/mean_reward
for part in learner router evaluator $(compose ps -q actor 2>/dev/null); do
    container=$(id "$part") || true
    await "$part is healthy" health_is "${container:-$part}" healthy
done
say "trains over mutual TLS: $(steps) steps, two actors, evaluations; all are healthy"

# --- what a part has -----------------------------------------------------------------------------------------------------
for part in learner router actor evaluator; do
    container=$(id "$part")
    # shellcheck disable=SC2016 # for the shell inside
    docker exec -i -e PART="$part" "$container" bash <<'INSIDE' || fail "$part is not confined"
set -eu
fail() { echo "$PART: $*" >&2; exit 1; }
has=$(find /certs -type f | sort | tr '\n' ' ')
want=$(printf '%s\n' "/certs/$PART/$PART.crt" "/certs/$PART/$PART.key" "/certs/$PART/ca.crt" | sort | tr '\n' ' ')
[ "$has" = "$want" ] || fail "it has $has"
modes="$(stat -c %a "/certs/$PART") $(stat -c %a "/certs/$PART/$PART.key")"
[ "$modes" = '700 600' ] || fail "its key has modes $modes"
[ "$(id -u)" = 10001 ] || fail "it is user $(id -u)"
grep -q '^CapEff:	0*$' /proc/self/status || fail 'it has capabilities'
for path in /x /certs/x "/certs/$PART/x" /usr/local/bin/x; do
    if touch "$path" 2>/dev/null; then fail "it can write $path"; fi
done
case $PART in
router) exec 3<>/dev/tcp/learner/7447 || fail 'it does not reach the learner' ;;
actor | evaluator)
    exec 3<>/dev/tcp/router/7447 || fail 'it does not reach the router'
    if (exec 3<>/dev/tcp/learner/7447) 2>/dev/null; then fail 'it reaches the learner'; fi
    ;;
esac
INSIDE
    limits=$(docker inspect -f '{{.HostConfig.Memory}} {{.HostConfig.NanoCpus}} {{.HostConfig.PidsLimit}}' "$container")
    case " $limits " in *" 0 "* | *"nil"*) fail "$part is not limited: $limits" ;; esac
done
say 'each part has its own key alone, no root, no capabilities, nowhere to write, limits, and only its own neighbours'

# --- who may do what -----------------------------------------------------------------------------------------------------
certs=$(compose ps -aq certs 2>/dev/null || compose ps -q certs)
mkdir "$work/certs"
for role in observer actor evaluator operator; do docker cp -q "$certs:/certs/$role" "$work/certs/" 2>/dev/null ||
    docker cp "$certs:/certs/$role" "$work/certs/" >/dev/null; done
port=$(docker port "$router" 7447 | sed -n '1s/.*://p')
python=${TREADMILL_PYTHON:-python3}
if "$python" -c 'import zenoh' 2>/dev/null; then
    "${enter[@]}" timeout 120 "$python" "$here/access.py" "tls/127.0.0.1:$port" "$work/certs" smoke
    say 'access rules hold'
else
    missing "$python has no eclipse-zenoh: access rules were NOT TESTED"
fi

# Compose's own way, with the operator's key and nobody else's.
operate() { compose run --rm -T --no-deps operator "$@" --connect tls/router:7447 --tls /certs/operator 2>>"$work/operator.log"; }
operate status >"$work/status" || { cat "$work/operator.log" >&2; fail 'status'; }
grep -q 'smoke' "$work/status" || { cat "$work/status" >&2; fail 'status does not name the run'; }
operate control pause >"$work/receipt" || { cat "$work/operator.log" >&2; fail 'pause'; }
paused=$(sed -n 's/.*(\([0-9]*\) env steps).*/\1/p' "$work/receipt")
operate control resume >/dev/null || fail 'resume'
await 'training that goes on' trains_beyond "$paused"
say "an operator asked for the status, paused at $paused steps and let it go on"

# --- more and fewer actors ----------------------------------------------------------------------------------------------
compose up -d --no-build --no-recreate --scale actor=4 2>/dev/null
await 'four actors' alive_is 4
compose up -d --no-build --no-recreate --scale actor=2 2>/dev/null
await 'two actors again' alive_is 2
say "scaled to four and back while it trained: $(steps) steps"

# --- deaths -----------------------------------------------------------------------------------------------------------------
# The process and not the container: after `docker kill` Docker leaves a container ended, whatever its restart policy.
main_process() { docker top "$1" -eo pid,comm | awk '$2 == "treadmill" { print $1 }' | sed -n 1p; }
restarted() { [ "$(docker inspect -f '{{.RestartCount}}' "$1")" -gt "$2" ]; }
actor=$(id actor)
kill -9 "$(main_process "$actor")"
await 'an actor that is started again' restarted "$actor" 0
await 'two actors again' alive_is 2
say 'an actor was killed and came back'

began() { docker inspect -f '{{.State.StartedAt}}' $(compose ps -q actor 2>/dev/null); }
actors_before=$(began) before=$(steps) killed=$SECONDS
kill -9 "$(main_process "$learner")"
await 'a learner that is started again' restarted "$learner" 0
await 'training that goes on' trains_beyond "$((before + 1000))"
docker logs "$learner" 2>&1 | grep 'going on with /runs/smoke' >/dev/null || fail 'the learner did not resume'
[ "$(began)" = "$actors_before" ] || fail 'an actor was started again because the learner died'
say "the learner was killed, resumed, and was beyond $before steps after $((SECONDS - killed)) s; no actor was started again"

before=$(steps) killed=$SECONDS
kill -9 "$(main_process "$router")"
await 'a router that is started again' restarted "$router" 0
await 'training that goes on' trains_beyond "$((before + 5000))"
await 'two actors again' alive_is 2
say "the router was killed and training was beyond $before steps after $((SECONDS - killed)) s"

# --- a learner that stands still is seen -------------------------------------------------------------------------------
docker exec "$learner" treadmill-health trains || fail 'the learner is well and its health check says no'
frozen=$(main_process "$learner")
kill -STOP "$frozen"
if docker exec "$learner" treadmill-health trains 2>/dev/null; then fail 'a frozen learner passes its health check'; fi
kill -CONT "$frozen"
await 'health after the thaw' docker exec "$learner" treadmill-health trains
say 'the health check sees a learner that stands still'

# --- the dashboard's questions, put to a real Prometheus -----------------------------------------------------------------
prometheus=${TREADMILL_PROMETHEUS:-prometheus}
if command -v "$prometheus" >/dev/null; then
    address=$(docker inspect -f "{{(index .NetworkSettings.Networks \"${project}_monitoring\").IPAddress}}" "$learner")
    sed "s/learner:9464/$address:9464/; s/scrape_interval: 10s/scrape_interval: 1s/; s/scrape_timeout: 5s/scrape_timeout: 1s/" \
        "$here/observability/prometheus.yml" >"$work/prometheus.yml"
    cp "$here/observability/alarms.yml" "$work"
    "${enter[@]}" "$prometheus" --config.file="$work/prometheus.yml" --storage.tsdb.path="$work/tsdb" \
        --web.listen-address=127.0.0.1:19090 >"$work/prometheus.log" 2>&1 &
    scraper=$!
    "${enter[@]}" timeout 120 "$python" "$here/observability/ask.py" http://127.0.0.1:19090 "$here/observability/grafana/dashboards/treadmill.json"
    kill "$scraper"
    wait "$scraper" 2>/dev/null || true
    scraper=
    say 'Prometheus answers every question of the dashboard'
else
    missing "there is no $prometheus: the dashboard's questions were NOT ASKED"
fi

# --- stop and go on ---------------------------------------------------------------------------------------------------------
before=$(steps)
compose stop 2>/dev/null
for container in $(docker ps -aq --filter "label=com.docker.compose.project=$project"); do
    code=$(docker inspect -f '{{.State.ExitCode}}' "$container")
    [ "$code" = 0 ] || fail "$(docker inspect -f '{{.Name}}' "$container") ended with $code"
done
docker logs --tail 5 "$learner" 2>&1 | grep 'saved in /runs/smoke/checkpoints' >/dev/null || fail 'the learner did not save'
saved=$(docker logs "$learner" 2>&1 | sed -n 's/^stopped after \([0-9]*\) env steps.*/\1/p' | tail -n 1)
[ "$saved" -ge "$before" ] || fail "saved at $saved steps, after $before"
compose start 2>/dev/null
learner=$(id learner)
await 'training that goes on' trains_beyond "$saved"
docker logs "$learner" 2>&1 | grep "going on at $saved env steps" >/dev/null || fail "the learner did not go on at $saved"
say "stopped, saved at $saved steps, every container with 0; started, resumed"
[ "$(value bus/fragments_malformed)" -le 3 ] || fail 'sound actors were refused'
say 'everything passed'
