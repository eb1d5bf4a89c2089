#!/usr/bin/env bash
# Runs the job scripts of this folder on a Slurm cluster of four nodes that exists only for this test: trains, requeues,
# preempts, drains, loses a node, grows, shrinks and stops. Takes two to four minutes.
#
#   sudo deploy/slurm/test.sh [target/release/treadmill]
#
# Needs Debian's packages slurm-wlm and munge, python3, and root, as which slurmd runs. Every daemon uses files and ports of
# this test only: a Slurm of this machine and its configuration stay as they are.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
binary=$(realpath "${1:-$here/../../target/release/treadmill}")
[ -x "$binary" ] || { echo "\`$binary\` does not exist; run \`cargo build --release\`" >&2; exit 2; }
export PATH=$PATH:/usr/sbin
for tool in munged slurmctld slurmd sbatch scontrol python3; do
    command -v "$tool" >/dev/null || { echo "$tool is missing: apt install slurm-wlm munge python3" >&2; exit 2; }
done
[ "$(id -u)" = 0 ] || { echo 'only root can run slurmd' >&2; exit 2; }
exec </dev/null

started=$SECONDS
say() { printf '%4d s  %s\n' $((SECONDS - started)) "$*"; }
fail() {
    printf '\n!!! %s\n' "$*" >&2
    exit 1
}
# Retries a command until it succeeds, for at most 90 s.
await() {
    local what=$1 until=$((SECONDS + 90))
    shift
    until "$@"; do
        [ "$SECONDS" -lt "$until" ] || fail "not within 90 s: $what"
        sleep 0.3
    done
}

work=$(mktemp -d)
nodes='1 2 3 4'
# Processes of this test: its daemons, and what they started, which has the configuration in its environment.
# The tools that look for them do not have it.
ours() (
    wanted="^SLURM_CONF=$SLURM_CONF\$"
    unset SLURM_CONF
    grep -lsz "$wanted" /proc/[0-9]*/environ | cut -d/ -f3
)
is_empty() { [ -z "$(ours)" ]; }
stop_cluster() {
    # Without its controller, scancel would wait for it.
    [ ! -e "$work/slurmctld.pid" ] || scancel --me 2>/dev/null
    for daemon in slurmctld slurmd-node1 slurmd-node2 slurmd-node3 slurmd-node4 munged; do
        [ ! -e "$work/$daemon.pid" ] || kill "$(cat "$work/$daemon.pid")" 2>/dev/null
    done
}
cleanup() {
    code=$?
    trap - EXIT
    set +e
    if [ "$code" != 0 ]; then
        sinfo -N
        squeue
        tail -n 5 "$work"/*.log "$work"/log/slurm*.log | cut -c1-300
    fi >&2
    stop_cluster
    for process in $(ours); do kill -9 "$process"; done 2>/dev/null
    rm -rf "$work"
    exit "$code"
}
trap cleanup EXIT

# --- cluster ---------------------------------------------------------------------------------------------------------------
chmod 755 "$work"
mkdir "$work/state" "$work/spool" "$work/log" "$work/bin"
ln -s "$binary" "$work/bin/treadmill"
export SLURM_CONF=$work/slurm.conf PATH=$work/bin:$PATH
# Set in a shell inside a job, these would change what is submitted here.
for name in $(compgen -e); do case $name in SLURM_CONF) ;; SLURM* | SBATCH_* | TREADMILL_*) unset "$name" ;; esac; done
first_port=$((20000 + $$ % 10000))
{
    cat <<SETTINGS
ClusterName=treadmill-test
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=$first_port
AuthType=auth/munge
AuthInfo=socket=$work/munge.sock
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool/%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
SlurmctldLogFile=$work/log/slurmctld.log
SlurmdLogFile=$work/log/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=5
SchedulerParameters=bf_interval=2,sched_interval=2
MessageTimeout=3
KillWait=30
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
PartitionName=main Nodes=ALL Default=YES PriorityTier=1
PartitionName=urgent Nodes=ALL PriorityTier=2 PreemptMode=OFF
SETTINGS
    for n in $nodes; do
        echo "NodeName=node$n NodeHostname=$(hostname) NodeAddr=127.0.0.1$n Port=$((first_port + n)) CPUs=2"
    done
} >"$SLURM_CONF"
dd if=/dev/urandom of="$work/munge.key" bs=128 count=1 status=none
chmod 600 "$work/munge.key"
# In a container, root does not own all folders above the socket.
munged --force --socket "$work/munge.sock" --key-file "$work/munge.key" --log-file "$work/log/munged.log" \
    --pid-file "$work/munged.pid" --seed-file "$work/munge.seed" 2>"$work/log/munged.err"
slurmctld
for n in $nodes; do slurmd -N "node$n"; done
idle() { [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 4 ]; }
await 'four idle nodes' idle
say "$(slurmctld -V), four nodes idle"

# --- helpers ---------------------------------------------------------------------------------------------------------------
cd "$work"
# shellcheck disable=SC2046 # one word each
sinfo -hN -o '--host=%o' | sort -u | xargs treadmill certs certs >/dev/null

# Prints a number of a run's status; -1 without an answer.
run=walk
status() {
    treadmill status "runs/$run" --tls certs --json 2>/dev/null | python3 -c '
import json, sys
line = sys.stdin.readline()
print(eval(sys.argv[1], {"run": json.loads(line)}) if line.startswith("{") else -1)' "$1"
}
updates() { status 'run["updates"]'; }
alive() { status 'sum(actor["state"] == "alive" for actor in run["actors"])'; }
updates_beyond() { [ "$(updates)" -gt "$1" ]; }
alive_is() { [ "$(alive)" = "$1" ]; }
# Awaits the number of actors, and 20 more updates with them.
trains_with() {
    await "$1 actors" alive_is "$1"
    local now
    now=$(updates)
    await "updates with $1 actors" updates_beyond $((now + 20))
}
job() { scontrol show job --oneliner "$1" 2>/dev/null | sed -n "s/.* $2=\([^ ]*\).*/\1/p"; }
job_is() { [ "$(job "$1" JobState)" = "$2" ]; }
waits_to_begin() { [ "$(job "$1" JobState) $(job "$1" Reason)" = 'PENDING BeginTime' ]; }
# Slurm lets a requeued job wait for two minutes. In the second of its end, the same node would refuse it as already ended.
hurry() {
    await "$1 is queued again" waits_to_begin "$1"
    scontrol update "jobid=$1" StartTime=now+3
}
contains() { grep -q "$2" "$1" 2>/dev/null; }
count_is() { [ "$(grep -c "$2" "$1" 2>/dev/null)" = "$3" ]; }

# --- training --------------------------------------------------------------------------------------------------------------
# Every job takes a whole node, so that it starts elsewhere when it has to leave.
learner=$(sbatch --parsable -c 2 "$here/learner.sbatch" --preset smoke --steps 1000000000)
log=walk-learner-$learner.log
array=$(sbatch --parsable --array=1-2 -c 2 "$here/actors.sbatch" --envs 4)
await 'the learner runs' job_is "$learner" RUNNING
trains_with 2
say "trains over mutual TLS: $(updates) updates; learner on $(job "$learner" NodeList), actors on" \
    "$(job "${array}_1" NodeList) and $(job "${array}_2" NodeList)"

# --- drained node ----------------------------------------------------------------------------------------------------------
node=$(job "${array}_1" NodeList)
scontrol update "nodename=$node" state=drain reason=test
is_drained() { [ "$(sinfo -h -n "$1" -o %T)" = drained ]; }
scontrol requeue "${array}_1"
await "$node has no job" is_drained "$node"
contains "walk-actor-${array}_1.log" '^left run' || fail 'the actor did not leave'
hurry "${array}_1"
await 'the actor runs again' job_is "${array}_1" RUNNING
[ "$(job "${array}_1" NodeList)" != "$node" ] || fail "the actor came back to $node"
trains_with 2
scontrol update "nodename=$node" state=resume
say "$node drained: its actor left and came back on $(job "${array}_1" NodeList); $(updates) updates"

# --- preempted learner -----------------------------------------------------------------------------------------------------
node=$(job "$learner" NodeList) before=$(updates) begun=$SECONDS
urgent=$(sbatch --parsable -p urgent -w "$node" -c 2 -o /dev/null --wrap 'exec sleep 600')
await 'the urgent job runs' job_is "$urgent" RUNNING
contains "$log" '^stopped after .* saved in' || fail 'the preempted learner did not save'
saved=$(sed -n 's/^stopped after \([0-9,]*\) env steps.*/\1/p' "$log")
left=$((SECONDS - begun))
hurry "$learner"
await 'the learner runs again' job_is "$learner" RUNNING
await 'it resumes' contains "$log" "resuming at $saved env steps"
trains_with 2
[ "$(updates)" -gt "$before" ] || fail "$(updates) updates, after $before"
say "learner preempted on $node: it saved $saved steps and left within $left s, resumed there on $(job "$learner" NodeList)," \
    "and the actors followed; $(updates) updates"
scancel "$urgent"

# --- lost node of an actor -------------------------------------------------------------------------------------------------
node=$(job "${array}_2" NodeList) begun=$SECONDS
kill -9 "$(cat "slurmd-$node.pid")"
await "${array}_2 is queued again" waits_to_begin "${array}_2"
found=$((SECONDS - begun))
alive_is 2 || fail 'the actor of the lost node ended, although only its slurmd was killed'
hurry "${array}_2"
await 'the actor runs elsewhere' job_is "${array}_2" RUNNING
[ "$(job "${array}_2" NodeList)" != "$node" ] || fail "the actor came back to $node"
trains_with 3
slurmd -N "$node"
# It ends what it finds from before.
trains_with 2
say "slurmd of $node killed: Slurm saw it after $found s, and started the actor on $(job "${array}_2" NodeList) beside the one" \
    "left behind, until slurmd came back; $(updates) updates"

# --- lost node of the learner ----------------------------------------------------------------------------------------------
node=$(job "$learner" NodeList)
kill -9 "$(cat "slurmd-$node.pid")"
hurry "$learner"
await 'the learner runs elsewhere' job_is "$learner" RUNNING
trains_with 2
count_is "$log" 'resuming at' 1 || fail 'two learners write into one run'
slurmd -N "$node"
await 'the second learner resumes' count_is "$log" 'resuming at' 2
trains_with 2
say "slurmd of $node killed: the learner left behind trained on, a second one waited on $(job "$learner" NodeList), and took" \
    "over when slurmd came back; $(updates) updates"

# --- more and fewer actors -------------------------------------------------------------------------------------------------
more=$(sbatch --parsable --array=1-1 -c 2 "$here/actors.sbatch" --envs 4)
trains_with 3
say "a second array: three actors; $(updates) updates"
scancel "${array}_1" "$more"
trains_with 1
say "tasks cancelled: one actor; $(updates) updates"

# --- sweep -----------------------------------------------------------------------------------------------------------------
sweep=$(sbatch --parsable -J seeds -c 2 "$here/sweep.sbatch" --seeds 2 --parallel 1 --actors 1 --envs 4 --preset smoke \
    --steps 100000000)
await 'a trial trains' contains runs/seeds/trial-1/metrics.jsonl time/iterations
# As Slurm does before the time limit.
scancel --batch --signal=USR1 "$sweep"
hurry "$sweep"
contains runs/seeds/trial-1.log 'saved in' || fail 'the trial did not save'
await 'the trial resumes' contains runs/seeds/trial-1.log 'resuming at'
scancel "$sweep"
say "sweep before its time limit: requeued, its trial saved and resumed"

# --- end -------------------------------------------------------------------------------------------------------------------
before=$(updates)
treadmill control stop --connect "$(cat runs/walk/endpoint.txt)" --run walk --tls certs >/dev/null
for id in "$learner" "${array}_2"; do
    await "$id completes" job_is "$id" COMPLETED
    [ "$(job "$id" ExitCode)" = 0:0 ] || fail "$id exited with $(job "$id" ExitCode)"
done
say "stopped after $before updates: learner and actors ended with exit code 0"

# --- pool ------------------------------------------------------------------------------------------------------------------
export TREADMILL_POOL=pool.txt
router=$(sbatch --parsable -c 1 "$here/router.sbatch")
for run in first second; do
    sbatch -Q -J "$run" -c 1 "$here/learner.sbatch" --preset smoke --steps 1000000000
done
pool=$(sbatch --parsable -J pool --array=1-2 -c 2 "$here/actors.sbatch" --envs 4)
for run in first second; do trains_with 1; done
say 'a router, two learners and a pool of two actors: both runs train'
endpoint=$(cat pool.txt)
scontrol requeue "$router"
hurry "$router"
has_moved() { [ "$(cat pool.txt)" != "$endpoint" ]; }
await 'another endpoint' has_moved
for run in first second; do trains_with 1; done
say "router requeued: learners and actors followed from $endpoint to $(cat pool.txt)"
scancel --me --name=first
run=second
trains_with 2
say 'the first run left: both actors work for the second one'
scancel --me
no_jobs() { [ -z "$(squeue -h)" ]; }
await 'the end of all jobs' no_jobs
contains "pool-actor-${pool}_1.log" '^left run' || fail 'an actor of the pool did not leave'

stop_cluster
await 'the end of every process' is_empty
say 'nothing is left running; all tests passed'
