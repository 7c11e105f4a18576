// The moment that everything on the page shows. Whoever sets it, all that listen follow: player, charts, maps.

export class Clock extends EventTarget {
  constructor(end) {
    super();
    this.end = end;
    this.time = 0;
  }

  set(time) {
    this.time = Math.min(Math.max(time, 0), this.end);
    this.dispatchEvent(new Event('change'));
  }

  follow(action) {
    this.addEventListener('change', () => action(this.time));
    action(this.time);
  }
}
