#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# h5py 3.16.0 writes, jhdf 0.11.0 (Maven Central) and jsfive 0.4.2 (npm) read: a table of a run that has not come to its end.
#
# Guess: rows that are not written yet come back as the fill value that the file names, NaN or -1, as h5py itself gives them.
# Seen:  jhdf gives 0, though its getFillValue knows the right one: a run that is half done has stresses of 0 to its end, and a d10 or a
#        mean of all rows is wrong without a sign of it. jsfive gives undefined, and sums are NaN.
#        Both do so for whole chunks that were never written; the rest of one that was begun is right. No warning.
# For us: tables of results are given their full size at the start, with NaN, and filled as a run goes on. Write the fill value into
#        all rows first, or tell in an attribute how many are done. `shearbox export` writes no HDF5.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q h5py==3.16.0 numpy==2.4.6
npm install --silent --no-fund --no-audit --no-save --ignore-scripts --prefix . jsfive@0.4.2 >/dev/null
for artifact in io.jhdf:jhdf:0.11.0 org.slf4j:slf4j-api:2.0.17 org.slf4j:slf4j-nop:2.0.17 org.apache.commons:commons-lang3:3.18.0; do
    mvn -q -B dependency:copy -Dartifact=$artifact -DoutputDirectory=jars >/dev/null
done

cat >write.py <<'END'
import h5py
import numpy as np

print("h5py", h5py.__version__)
with h5py.File("run.h5", "w") as file:
    for name, kind, fill in ("stress", "f8", np.nan), ("contacts", "i4", -1):
        data = file.create_dataset(name, (8,), kind, chunks=(3,), fillvalue=fill)
        data[:4] = np.arange(100, 104)  # the second chunk is begun, the third is not
        print(f"{name}: fill value {data.fillvalue}, by h5py {data[:].tolist()}")
END
cat >Read.java <<'END'
public class Read {
    public static void main(String[] arguments) {
        try (var file = new io.jhdf.HdfFile(java.nio.file.Path.of("run.h5"))) {
            for (var name : file.getChildren().keySet()) {
                var dataset = file.getDatasetByPath("/" + name);
                var rows = new StringBuilder(name + ": fill value " + dataset.getFillValue() + ", by jhdf");
                for (int i = 0; i < 8; i++) rows.append(" ").append(java.lang.reflect.Array.get(dataset.getData(), i));
                System.out.println(rows);
            }
        }
    }
}
END
cat >read.mjs <<'END'
import { readFileSync } from 'node:fs';
import { File } from 'jsfive';

const file = new File(Uint8Array.from(readFileSync('run.h5')).buffer, 'run.h5');
for (const name of file.keys) console.log(`${name}: by jsfive`, Array.from(file.get(name).value, String).join(' '));
END

seen=$(
    venv/bin/python write.py
    java -cp 'jars/*' Read.java
    node read.mjs
)
expected='h5py 3.16.0
stress: fill value nan, by h5py [100.0, 101.0, 102.0, 103.0, nan, nan, nan, nan]
contacts: fill value -1, by h5py [100, 101, 102, 103, -1, -1, -1, -1]
contacts: fill value -1, by jhdf 100 101 102 103 -1 -1 0 0
stress: fill value NaN, by jhdf 100.0 101.0 102.0 103.0 NaN NaN 0.0 0.0
contacts: by jsfive 100 101 102 103 -1 -1 undefined undefined
stress: by jsfive 100 101 102 103 NaN NaN undefined undefined'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
