# SPDX-License-Identifier: GPL-3.0-or-later
# For scripts of this folder to source: a Slurm cluster of this machine alone, in a folder of its own.
# shellcheck shell=bash

# start_slurm FOLDER: munged, slurmctld and slurmd, by which sbatch, squeue and scancel then work. Fails
# if the node does not come up. Their processes are in slurm_pids.
start_slurm() {
  local folder=$1 port host user
  host=$(hostname -s) user=$(id -un) port=$((20000 + RANDOM % 20000))
  mkdir -p -- "$folder/state" "$folder/spool"
  chmod 700 -- "$folder"
  head -c 1024 /dev/urandom >"$folder/munge.key"
  chmod 600 -- "$folder/munge.key"
  export SLURM_CONF=$folder/slurm.conf
  cat >"$SLURM_CONF" <<CONF
ClusterName=insitu_test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthInfo=socket=$folder/munge.socket
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MpiDefault=none
MinJobAge=2
SchedulerParameters=sched_interval=1,defer_batch=no
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  slurm_pids=()
  munged --foreground --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
    --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" --seed-file="$folder/munge.seed" \
    >"$folder/munge.out" 2>&1 &
  slurm_pids+=("$!")
  wait_for test -S "$folder/munge.socket" || return 1
  slurmctld -D >"$folder/slurmctld.out" 2>&1 &
  slurm_pids+=("$!")
  wait_for sinfo || return 1
  slurmd -D >"$folder/slurmd.out" 2>&1 &
  slurm_pids+=("$!")
  wait_for is_node_idle
}

is_node_idle() { sinfo --noheader --format=%T | grep -qx idle; }

# wait_for COMMAND...: until it succeeds, at most ${SECONDS_TO_WAIT:-30} seconds.
wait_for() {
  local end=$((SECONDS + ${SECONDS_TO_WAIT:-30}))
  until "$@" >/dev/null 2>&1; do
    [[ $SECONDS -lt $end ]] || return 1
    sleep 0.2
  done
}

is_queue_empty() { [[ -z $(squeue --noheader) ]]; }

# Jobs that still run end before what watches them.
stop_slurm() {
  local i
  scancel --user="$(id -un)" 2>/dev/null || true
  SECONDS_TO_WAIT=20 wait_for is_queue_empty || true
  for ((i = ${#slurm_pids[@]} - 1; i >= 0; --i)); do
    kill "${slurm_pids[i]}" 2>/dev/null || true
    wait "${slurm_pids[i]}" 2>/dev/null || true
  done
}
