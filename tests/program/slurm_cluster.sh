# A Slurm cluster of one node for a test. Source it, call start_cluster, and call stop_cluster in a trap. It starts munged,
# slurmctld and slurmd in a temporary folder on free ports, and does not touch daemons of the system.
# shellcheck shell=bash

cluster=  # folder
daemons=()

# The reason why a cluster cannot be started here; empty if it can.
cluster_obstacle() {
  local tool
  for tool in munged slurmctld slurmd sbatch squeue scancel scontrol sinfo; do
    command -v "$tool" >/dev/null || { echo "$tool is not installed (Debian: apt-get install slurm-wlm)"; return; }
  done
}

free_ports() {
  python3 -c 'import socket
sockets = [socket.socket() for _ in range(2)]
for s in sockets: s.bind(("127.0.0.1", 0))
print(*(s.getsockname()[1] for s in sockets))'
}

write_configuration() {
  local node user ports
  node=$(hostname -s)
  user=$(id -un)
  read -r -a ports < <(free_ports)
  cat >"$cluster/slurm.conf" <<EOF
ClusterName=bristle
SlurmctldHost=$node(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$cluster/munge.socket
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.pid
# No control groups, binding or accounting, because containers may lack them.
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
MailProg=/bin/true
ReturnToService=2
KillWait=10
NodeName=$node NodeAddr=127.0.0.1 Port=${ports[1]} CPUs=4 State=UNKNOWN
PartitionName=test Nodes=$node Default=YES MaxTime=INFINITE State=UP
EOF
}

start_daemon() {
  "$@" >"$cluster/$1.log" 2>&1 &
  daemons+=($!)
}

# within SECONDS COMMAND...: whether the command succeeds within this time.
within() {
  local seconds=$1 end
  shift
  end=$((SECONDS + seconds))
  until "$@"; do
    [ $SECONDS -lt $end ] || return 1
    sleep 0.2
  done
}

node_is_idle() { [ "$(timeout 10 sinfo -h -o %t 2>/dev/null)" = idle ]; }

# Starts the cluster. Fails if it does not start; its logs are in $cluster.
start_cluster() {
  cluster=$(mktemp -d /tmp/bristle-slurm-XXXXXX)  # a short path, because names of sockets are limited to 107 characters
  chmod 755 "$cluster"  # munged requires that all users can access its socket
  mkdir "$cluster/state" "$cluster/spool"
  (umask 077 && head -c 128 /dev/urandom >"$cluster/munge.key")
  write_configuration
  export SLURM_CONF=$cluster/slurm.conf  # for the clients, and to identify processes of this cluster
  start_daemon munged --foreground --force --num-threads=2 --key-file="$cluster/munge.key" \
    --socket="$cluster/munge.socket" --pid-file="$cluster/munged.pid" --seed-file="$cluster/munge.seed" \
    --log-file="$cluster/munge.log"
  within 20 test -S "$cluster/munge.socket" || return 1
  start_daemon slurmctld -D -f "$SLURM_CONF"
  start_daemon slurmd -D -f "$SLURM_CONF"
  within 60 node_is_idle
}

# Running processes of this cluster: those with its SLURM_CONF.
cluster_processes() {
  local file
  for file in /proc/[0-9]*/environ; do
    if env -u SLURM_CONF grep -qzxF "SLURM_CONF=$SLURM_CONF" "$file" 2>/dev/null; then basename "$(dirname "$file")"; fi
  done
}

no_jobs() { [ -z "$(timeout 10 squeue -h 2>/dev/null)" ]; }

# Ends jobs and daemons and removes the folder. Fails if processes had to be killed, and names them.
stop_cluster() {
  local left pid
  [ -n "$cluster" ] || return 0
  if node_is_idle || timeout 10 sinfo -h >/dev/null 2>&1; then
    timeout 10 scancel --user="$(id -un)" 2>/dev/null
    within 30 no_jobs
  fi
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
    kill "${daemons[i]}" 2>/dev/null
    within 20 eval "! kill -0 ${daemons[i]} 2>/dev/null"
  done
  left=$(cluster_processes)
  for pid in $left; do
    echo "left over: process $pid: $(tr '\0' ' ' <"/proc/$pid/cmdline")"
    kill -KILL "$pid" 2>/dev/null
  done
  rm -rf "$cluster"
  cluster=
  [ -z "$left" ]
}
