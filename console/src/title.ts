// Marks of the page's title, for people who look elsewhere. The page sounds once for each new one.

let title = document.title;
const marks = new Map<string, string>();

const draw = () => { document.title = [...marks.values(), title].join("  "); };

// The title without marks; it also stands after them.
export function setTitle(text: string) {
  if (title === text) return;
  title = text;
  draw();
}

export function mark(name: string, text: string) {
  const before = marks.get(name) ?? "";
  if (before === text) return;
  if (text) marks.set(name, text); else marks.delete(name);
  draw();
  if (text && document.hidden) ring();
}

export function ring() {
  try {
    const audio = new AudioContext(), tone = audio.createOscillator(), gain = audio.createGain();
    gain.gain.value = 0.05;
    tone.connect(gain).connect(audio.destination);
    tone.onended = () => void audio.close();
    tone.start();
    tone.stop(audio.currentTime + 0.25);
  } catch { /* browsers are silent before the first click */ }
}
