#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# slurm_here.sh COMMAND...: runs a command beside a real Slurm of two nodes on this machine, in a temporary folder, and ends it after.
# In its environment: SLURM_CONF, and SLURM_HERE with the folder (n0.pid and n1.pid are the nodes' processes).
# Needs root and the packages under [cluster] of packages.txt.
set -euo pipefail

[ $# -gt 0 ] || { echo "usage: slurm_here.sh COMMAND..." >&2; exit 2; }
for tool in slurmctld slurmd sbatch munged; do
    command -v "$tool" >/dev/null || PATH=$PATH:/usr/sbin command -v "$tool" >/dev/null ||
        { echo "slurm_here.sh: $tool is missing; install slurm-wlm and munge" >&2; exit 3; }
done
[ "$(id -u)" = 0 ] || { echo "slurm_here.sh: needs root: the daemons start jobs as their users" >&2; exit 3; }
export PATH=$PATH:/usr/sbin

# munged wants every folder down to its socket to be closed to writing by others.
here=$(mktemp -d "${SLURM_HERE_PARENT:-/run}/tribo-slurm-XXXXXX")
chmod 755 "$here"
host=$(hostname -s)
first_port=${SLURM_HERE_PORT:-17000}

end() {
    for pid in "$here"/*.pid; do
        [ -s "$pid" ] && kill "$(cat "$pid")" 2>/dev/null || true
    done
    sleep 0.5
    for pid in "$here"/*.pid; do
        [ -s "$pid" ] && kill -9 "$(cat "$pid")" 2>/dev/null || true
    done
    rm -rf "$here"
}
trap end EXIT

mkdir -p "$here"/{state,spool-n0,spool-n1}
(umask 077 && head -c 1024 /dev/urandom >"$here/munge.key" && chmod 400 "$here/munge.key")
cat >"$here/slurm.conf" <<CONF
ClusterName=here
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$first_port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$here/munge.socket
CryptoType=crypto/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
MinJobAge=300
MaxArraySize=10001
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
StateSaveLocation=$here/state
SlurmctldPidFile=$here/slurmctld.pid
SlurmctldLogFile=$here/slurmctld.log
SlurmdSpoolDir=$here/spool-%n
SlurmdPidFile=$here/%n.pid
SlurmdLogFile=$here/%n.log
NodeName=n0 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((first_port + 1)) CPUs=1 RealMemory=1000
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((first_port + 2)) CPUs=1 RealMemory=1000
PartitionName=all Nodes=n0,n1 Default=YES MaxTime=INFINITE State=UP
CONF

munged --force --key-file="$here/munge.key" --socket="$here/munge.socket" --pid-file="$here/munged.pid" \
    --log-file="$here/munged.log" --seed-file="$here/munge.seed"
export SLURM_CONF=$here/slurm.conf SLURM_HERE=$here
slurmctld -f "$SLURM_CONF"
slurmd -N n0 -f "$SLURM_CONF"
slurmd -N n1 -f "$SLURM_CONF"
for _ in $(seq 100); do
    [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ] && break
    sleep 0.2
done
[ "$(sinfo -h -t idle -o %D)" = 2 ] || { echo "slurm_here.sh: the nodes did not start" >&2; cat "$here"/*.log >&2; exit 1; }
"$@"
