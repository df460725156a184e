// The content of a control's screen. It comes as a whole when its frame changes, else the cells that have changed.
export default {
  template: "<div></div>",
  created() {
    this.cells = [];
  },
  methods: {
    whole(markup) {
      this.$el.innerHTML = markup;
      this.cells = this.$el.querySelectorAll("td, .status span");
    },
    change(cells) {
      for (const [at, text, style] of cells) {
        const cell = this.cells[at];
        if (cell.className !== style) cell.className = style;
        if (cell.firstChild) cell.firstChild.nodeValue = text;
        else cell.textContent = text;
      }
    },
  },
};
