#!/bin/sh
# check_oracle.sh [PROGRAM]: answers all reference cases of the shared oracle with `vis2hap analyse` and compares
# them with the oracle's own scorer. Prints the percentage of every family. The folder of the oracle is in
# VIS2HAP_SHARED, otherwise in ../shared beside the repository. If it is missing, the script prints this and
# compares nothing. Exit code 1: a case is wrong.
set -eu
root=$(cd "$(dirname "$0")/../../.." && pwd)
program=${1:-$root/build/vis2hap}
oracle=${VIS2HAP_SHARED:-$root/../shared}/oracle
if [ ! -f "$oracle/score.py" ]; then
    echo "check_oracle.sh: no reference cases in $oracle: nothing was compared (set VIS2HAP_SHARED)"
    exit 0
fi
answers=$(mktemp -d)
trap 'rm -rf "$answers"' EXIT
for cases in "$oracle"/cases/public "$oracle"/ssim/public; do
    for requests in "$cases"/*.json; do
        "$program" analyse "$requests" --out "$answers/$(basename "$requests")"
    done
done
python3 - "$oracle" "$answers" <<'PYTHON'
import glob, json, os, subprocess, sys
oracle, folder = sys.argv[1:]
merged = {}
for part in glob.glob(os.path.join(folder, '*.json')):
    merged.update(json.load(open(part)))
answers = os.path.join(folder, 'answers')
json.dump(merged, open(answers, 'w'))
right = total = 0
for cases in ('cases/public', 'ssim/public'):
    score = subprocess.run([sys.executable, os.path.join(oracle, 'score.py'), os.path.join(oracle, cases), answers, '--verbose'],
                           check=True, capture_output=True, text=True).stdout
    for line in score.splitlines():
        words = line.split()
        if line.startswith(' '):
            print(line)
        elif words[0] != 'TOTAL':
            ok, of = int(words[1]), int(words[3])
            right, total = right + ok, total + of
            print('%-10s %3d of %3d  %5.1f %%' % (words[0], ok, of, 100 * ok / of))
print('%-10s %3d of %3d  %5.1f %%' % ('all', right, total, 100 * right / total))
sys.exit(right != total)
PYTHON
