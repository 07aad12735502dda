#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# trackpy 0.7: drift of tracked grains when a picture of the film was lost.
#
# Guess: of grains that all move alike drift is that motion, and nothing is left when it is subtracted, whichever grains come, go or
#        are missed in some frames.
# Seen:  so it is as long as each frame has some of the grains and the one before it has some of these. If a frame is missing for
#        all, the motion from before to after it is left out for good, two frames' worth; and in the first frame after it nothing
#        at all is subtracted, so that every grain leaps there by all it has moved so far, and most of the way back. In a film of
#        which every second picture is there nothing is subtracted anywhere. Displacements squared of msd and emsd are right
#        across gaps. No warning (Pandas' own on its future aside), and no word of it.
# For us: the part of a shear box that slides as a block is such a drift, and cameras lose pictures. Number the frames without gaps
#        for compute_drift, as below, or subtract a mean over the same grains. Positions of models come from every frame.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile trackpy==0.7 numpy==2.4.6 scipy==1.17.1 pandas==2.3.3

cat >drift.py <<'END'
import warnings

warnings.simplefilter("error", UserWarning)
import numpy as np
import pandas as pd
import trackpy as tp

print("trackpy", tp.__version__)
FRAMES, STEP = 12, np.array([1.0, -0.5])  # pixels from one frame to the next
places = np.random.default_rng(1).uniform(0, 100, (5, 2))
film = pd.DataFrame([(frame, grain, *(places[grain] + frame * STEP)) for frame in range(FRAMES) for grain in range(5)],
                    columns=["frame", "particle", "x", "y"])
films = {"all": film, "each grain missed in some": film[(film.frame + film.particle) % 4 != 1],
         "frame 5 lost": film[film.frame != 5], "every second": film[film.frame % 2 == 0]}


def leaps(tracks, drift):
    rest = tp.subtract_drift(tracks.copy(), drift).reset_index(drop=True)
    x = rest[rest.particle == 0].set_index("frame").x
    return " ".join(f"{value:.0f}" for value in (x - x.iloc[0]).round(6) + 0.0)


for name, tracks in films.items():
    drift = tp.compute_drift(tracks)
    last = f"{drift.x.iloc[-1]:.0f}" if len(drift) else "none"
    moved = tracks.groupby("particle").x.agg(np.ptp).max()
    print(f"{name}: moved {moved:.0f}, drift {last}; x of a grain without drift: {leaps(tracks, drift)};",
          f"emsd at 2 frames {tp.emsd(tracks, 1, 1, max_lagtime=2).iloc[-1]:.2f}")

    numbers = {frame: number for number, frame in enumerate(sorted(tracks.frame.unique()))}
    dense = tracks.assign(frame=tracks.frame.map(numbers))
    print(f"  numbered without gaps: drift {tp.compute_drift(dense).x.iloc[-1]:.0f}; x {leaps(dense, tp.compute_drift(dense))}")
END

seen=$(venv/bin/python drift.py)
expected='trackpy 0.7
all: moved 11, drift 11; x of a grain without drift: 0 0 0 0 0 0 0 0 0 0 0 0; emsd at 2 frames 5.00
  numbered without gaps: drift 11; x 0 0 0 0 0 0 0 0 0 0 0 0
each grain missed in some: moved 11, drift 11; x of a grain without drift: 0 0 0 0 0 0 0 0 0; emsd at 2 frames 5.00
  numbered without gaps: drift 11; x 0 0 0 0 0 0 0 0 0
frame 5 lost: moved 11, drift 9; x of a grain without drift: 0 0 0 0 0 6 2 2 2 2 2; emsd at 2 frames 5.00
  numbered without gaps: drift 11; x 0 0 0 0 0 0 0 0 0 0 0
every second: moved 10, drift none; x of a grain without drift: 0 2 4 6 8 10; emsd at 2 frames 5.00
  numbered without gaps: drift 10; x 0 0 0 0 0 0'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
