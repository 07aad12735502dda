// SPDX-License-Identifier: GPL-2.0-or-later
// What is wrong with the layout of a document, as sentences: elements beyond its sides, text that is cut off or lies on
// other text, pictures that do not show, and the same of texts in SVG pictures. Tables in elements of class scrolls may be
// wider than the page: these scroll.

const ROUNDING = 1; // px
const OVERLAP = 2; // px, in both directions: boxes of letters have some air

function faults(doc) {
  const elements = [...doc.body.querySelectorAll('*')].filter(e => !e.closest('.scrolls'));
  return [
    ...elements.filter(e => !within(e.getBoundingClientRect(), doc.documentElement)).map(e => `beyond the page: ${name(e)}`),
    ...elements.filter(isCutOff).map(e => `cut off: ${name(e)}`),
    ...overlaps(texts(doc)).map(pair => `text on text: ${pair}`),
    ...[...doc.images].filter(i => !i.naturalWidth).map(i => `no picture: ${i.alt}`),
    ...[...doc.images].filter(i => i.src.startsWith('data:image/svg')).flatMap(faultsOfPicture),
  ];
}

function within(box, element) {
  return box.left >= -ROUNDING && box.right <= element.clientWidth + ROUNDING;
}

function isCutOff(e) { // inline elements have no clientWidth
  const tall = getComputedStyle(e).overflowY !== 'visible' && e.scrollHeight > e.clientHeight + ROUNDING;
  return e.clientWidth && (e.scrollWidth > e.clientWidth + ROUNDING || tall);
}

function texts(doc) {
  const walker = doc.createTreeWalker(doc.body, NodeFilter.SHOW_TEXT), found = [];
  while (walker.nextNode()) {
    const range = doc.createRange();
    range.selectNodeContents(walker.currentNode);
    const text = walker.currentNode.textContent.trim();
    if (text) found.push(...[...range.getClientRects()].map(box => ({text, box})));
  }
  return found;
}

function overlaps(boxes) {
  const found = [];
  boxes.sort((a, b) => a.box.top - b.box.top);
  boxes.forEach((one, i) => {
    for (let k = i + 1; k < boxes.length && boxes[k].box.top < one.box.bottom - OVERLAP; k++) {
      const a = one.box, b = boxes[k].box;
      if (one.text !== boxes[k].text && Math.min(a.right, b.right) - Math.max(a.left, b.left) > OVERLAP)
        found.push(`'${one.text}' and '${boxes[k].text}'`);
    }
  });
  return found;
}

function faultsOfPicture(image) { // as large as it is shown; matplotlib draws each text as a group of its own
  const place = document.createElement('div');
  place.style = `position: absolute; left: 0; top: 0; width: ${image.clientWidth}px`;
  place.innerHTML = new TextDecoder().decode(Uint8Array.from(atob(image.src.split(',')[1]), c => c.charCodeAt(0)));
  document.body.append(place);
  const svg = place.querySelector('svg');
  svg.style = 'display: block; width: 100%; height: auto';
  const labels = [...svg.querySelectorAll('g[id^=text_]')].map(g => ({text: label(g), box: g.getBoundingClientRect()}));
  const frame = svg.getBoundingClientRect();
  const out = labels.filter(({box}) => box.top < -ROUNDING || box.bottom > frame.height + ROUNDING || !within(box, place));
  const found = [...out.map(({text}) => `beyond its picture: ${text}`), ...overlaps(labels).map(p => `text on text: ${p}`)];
  if (!labels.length) found.push('no text');
  place.remove();
  return found.map(f => `${f} in '${image.alt}'`);
}

function label(group) { // its words stand in a comment
  const comment = [...group.childNodes].find(n => n.nodeType === Node.COMMENT_NODE);
  return `${group.id} ${comment ? comment.data.trim() : ''}`;
}

function name(e) {
  return `<${e.localName} class="${e.className}"> ${e.textContent.trim().slice(0, 40)}`;
}
