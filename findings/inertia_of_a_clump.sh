#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Matter.js 0.20.0, p2-es 1.2.3 and cannon-es 0.20.0, beside Planck.js 1.5.0: moments of inertia of a disc, a sphere and a clump.
#
# Guess: engines for bodies in a plane or in space disagree about contacts, not about inertia: a disc has m r^2 / 2, a sphere
#        2/5 m r^2, and a clump of two discs the sum of each with its m d^2.
# Seen:  Matter.js has four times the inertia for a disc, and of a clump it adds those of the discs as if they lay in one point. p2
#        takes the mass of the whole for each part: twice the inertia for two discs, and n times for n. cannon-es gives a sphere that
#        of its box, 2/3. Planck.js is right. No word of it in the manuals.
# For us: inertia of clumps is computed by closed forms here. Who shows grains in a browser with these engines: set the inertia
#        (in p2 and cannon-es after each change of the shapes).
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-fund --no-audit matter-js@0.20.0 p2-es@1.2.3 cannon-es@0.20.0 planck@1.5.0 >/dev/null

cat >inertia.mjs <<'END'
import * as cannon from 'cannon-es';
import Matter from 'matter-js';
import * as p2 from 'p2-es';
import * as planck from 'planck';

// n discs in a row that touch; inertia by mass and square of their radius
const R = 100; // large: Matter.js draws a disc with as many sides
const places = (n) => [...Array(n).keys()].map((i) => (2 * i - (n - 1)) * R);
const right = (n) => 0.5 + places(n).reduce((sum, x) => sum + x * x, 0) / n / R ** 2;

const engines = {
  'Matter.js': (n) => {
    const parts = places(n).map((x) => Matter.Bodies.circle(x, 0, R, {}, R));
    const body = n > 1 ? Matter.Body.create({ parts }) : parts[0];
    return body.inertia / body.mass / R ** 2;
  },
  p2: (n) => {
    const body = new p2.Body({ mass: 1 });
    for (const x of places(n)) body.addShape(new p2.Circle({ radius: R }), [x, 0]);
    return body.inertia / body.mass / R ** 2;
  },
  'Planck.js': (n) => {
    const body = new planck.World().createBody({ type: 'dynamic' });
    for (const x of places(n)) body.createFixture({ shape: new planck.Circle(new planck.Vec2(x, 0), R), density: 1 });
    return body.getInertia() / body.getMass() / R ** 2;
  },
};
for (const [name, inertia] of Object.entries(engines)) {
  console.log(`${name}:`, ...[1, 2, 3].map((n) => `${n} disc(s) ${inertia(n).toFixed(2)}, right ${right(n).toFixed(2)};`));
}
const ball = new cannon.Body({ mass: 1, shape: new cannon.Sphere(1) });
console.log(`cannon-es: sphere ${ball.inertia.x.toFixed(2)}, right 0.40`);
END

seen=$(node inertia.mjs)
expected='Matter.js: 1 disc(s) 2.00, right 0.50; 2 disc(s) 2.00, right 1.50; 3 disc(s) 2.00, right 3.17;
p2: 1 disc(s) 0.50, right 0.50; 2 disc(s) 3.00, right 1.50; 3 disc(s) 9.50, right 3.17;
Planck.js: 1 disc(s) 0.50, right 0.50; 2 disc(s) 1.50, right 1.50; 3 disc(s) 3.17, right 3.17;
cannon-es: sphere 0.67, right 0.40'
printf '%s\n' "$seen"
[[ $seen == "$expected" ]] || { printf 'changed: expected\n%s\n' "$expected" >&2; exit 1; }
