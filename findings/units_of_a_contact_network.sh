#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# igraph 1.0.0 and NetworkX 3.6.1: networks of contacts whose weights are in SI units.
#
# Guess: which grains matter does not depend on the unit of the weights: betweenness, communities and eigenvector centrality are
#        the same in m as in nm, in J as in nJ.
# Seen:  with overlaps in m, a few nm each, the betweenness by igraph of 32 of 120 grains is off by more than 10 %, and its leading
#        eigenvector finds 5 communities in place of 8: lengths of paths that differ by 1e-10 seem to count as equal. It warns only
#        of weights below that. With energies in J NetworkX gives every grain the same eigenvector centrality and says that it has
#        converged: its tolerance, 1e-6, is larger than the weights. Betweenness by NetworkX and eigenvector centrality by igraph
#        are right.
# For us: tables of contacts are in SI units. Divide weights by their mean before either sees them.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --no-compile igraph==1.0.0 networkx==3.6.1 numpy==2.4.6 scipy==1.17.1

cat >network.py <<'END'
import igraph
import networkx
import numpy as np

print("igraph", igraph.__version__, "networkx", networkx.__version__)
random = np.random.default_rng(3)
grains = random.uniform(0, 20, (120, 2))
distance = np.linalg.norm(grains[:, None] - grains, axis=2)
contacts = np.argwhere(np.triu(distance < 3, 1)).tolist()
overlap = random.uniform(1, 8, len(contacts))  # nm
energy = random.uniform(1, 8, len(contacts))  # nJ


def networks(weights):
    """The network with these weights in both libraries."""
    weights = weights.tolist()
    graph = networkx.Graph()
    graph.add_weighted_edges_from((a, b, weight) for (a, b), weight in zip(contacts, weights))
    return graph, igraph.Graph(len(grains), contacts, edge_attrs={"weight": weights})


def ratio(centrality):
    return max(centrality) * len(centrality) / sum(centrality)


for unit, size in ("nm", 1), ("m", 1e-9):
    graph, same = networks(overlap * size)
    between = np.array(same.betweenness(weights="weight"))
    other = networkx.betweenness_centrality(graph, weight="weight", normalized=False)
    other = np.array([other[grain] for grain in range(len(grains))])
    print(f"overlaps in {unit}: largest betweenness {between.max():.0f} by igraph, {other.max():.0f} by NetworkX;",
          f"they differ by more than 10 % for {np.sum(abs(between - other) > 0.1 * other)} of {len(grains)} grains;",
          "communities by the leading eigenvector", len(same.community_leading_eigenvector(weights="weight")))
for unit, size in ("nJ", 1), ("J", 1e-9):
    graph, same = networks(energy * size)
    print(f"energies in {unit}: eigenvector centrality, largest by mean",
          f"{ratio(list(networkx.eigenvector_centrality(graph, max_iter=1000, weight='weight').values())):.2f} by NetworkX,",
          f"{ratio(same.eigenvector_centrality(weights='weight')):.2f} by igraph")
END

seen=$(OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 venv/bin/python network.py 2>&1)
expected='igraph 1.0.0 networkx 3.6.1
overlaps in nm: largest betweenness 2168 by igraph, 2168 by NetworkX; they differ by more than 10 % for 0 of 120 grains; communities by the leading eigenvector 8
overlaps in m: largest betweenness 2102 by igraph, 2168 by NetworkX; they differ by more than 10 % for 32 of 120 grains; communities by the leading eigenvector 5
energies in nJ: eigenvector centrality, largest by mean 5.71 by NetworkX, 5.71 by igraph
energies in J: eigenvector centrality, largest by mean 1.00 by NetworkX, 5.71 by igraph'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
