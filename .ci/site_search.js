// Full-text search over the list of pages: all words must occur; matches in titles come first.
const script = document.currentScript;
const input = document.querySelector('nav input');
const list = document.querySelector('#found');
const fold = text => text.normalize('NFKC').toLowerCase();
input.addEventListener('input', () => {
  const words = fold(input.value).split(/\s+/).filter(Boolean);
  const rank = ([title, , text]) => {
    const [head, body] = [fold(title), fold(text)];
    if (!words.every(w => head.includes(w) || body.includes(w))) return 0;
    return words.every(w => head.includes(w)) ? 2 : 1;
  };
  const found = words.length ? window.pages.map(p => [rank(p), p]).filter(([r]) => r).sort((a, b) => b[0] - a[0]).slice(0, 20) : [];
  list.replaceChildren(...found.map(([, [title, page]]) => {
    const item = document.createElement('li');
    const link = document.createElement('a');
    link.href = script.dataset.root + page;
    link.textContent = title;
    item.append(link);
    return item;
  }));
});
