# SPDX-License-Identifier: Apache-2.0
# One life of the board "b" in the guest of power_cuts.py, from its boot to the loss of power. What is seen is printed: F what is
# wrong, B a recording that has begun some seconds ago, I one that can be read, E one that cannot, A what the agent says, N nothing was deployed yet, R the values and D the deployment
# that are there, L how many deployments and files are kept, X why a deployment was not committed.
disk=/var/lib/indurop
export INDUROP_STATE_DIR=$disk/agent HOME=/tmp
values() { indurop get --node b kept::count kept::last -o csv 2>/dev/null | tr -cs '0-9' ' '; }

mkdir -p $disk
mount -t ext4 /dev/vda $disk || echo "F the file system cannot be mounted"
dmesg | grep -E 'EXT4-fs.*(error|corrupt)' | sed 's/^/F /'
mkdir -p $disk/recordings
for file in "$disk"/recordings/*.mcap; do
  [ -e "$file" ] || continue
  if indurop recording info "$file" >/tmp/info 2>&1; then
    echo "I ${file##*/}"
  else
    echo "E ${file##*/} of $(stat -c %s "$file") bytes: $(tail -n 1 /tmp/info)"
  fi
  rm "$file"
done
echo "I"

if [ -e $disk/agent/b/committed.json ]; then old=yes; else old=no; fi
: >/tmp/agent.log
indurop-agent --board b --one-host >>/tmp/agent.log 2>&1 &
tail -n +1 -f /tmp/agent.log | while read -r line; do echo "A $line"; done &
if [ $old = no ]; then
  echo "N"
else
  # A node that is starting has not restored its values yet.
  until indurop status --node b -o json >/tmp/status 2>/dev/null && grep -q '"state":"running"' /tmp/status; do sleep 0.2; done
  echo "R$(values)"
  echo "D $(grep -o '"deployment":"[0-9a-f]*"' /tmp/status | cut -d'"' -f4)"
  echo "L $(ls $disk/agent/b/deployments | wc -l) $(ls $disk/agent/b/files | wc -l) $(ls $disk/agent/b/parts | wc -l)"
fi

number=0
while :; do
  number=$((number + 1))
  indurop record --node b -q -o $disk/recordings/$number.mcap --duration 20s >/dev/null 2>&1 &
  sleep 5
  if kill -0 $!; then echo "B $number.mcap"; fi
  wait $!
done &
while :; do
  head -c 2000000 /dev/urandom >/test/data.bin
  indurop deploy /test/plant.xml --one-host --timeout 5min --health 2s >/tmp/deploy.log 2>&1 || echo "X $(tail -n 3 /tmp/deploy.log | tr "\n" "|")"
  sleep 1
done
