/** The contacts as a table, and one of them with all that the ledger says of it. */

import { engineering, quantity } from "litz/data.js";

const SHOWN = ["id", "elements", "force", "current", "penetration"];
const WORDS = ["id", "elements"];
const MOST_ROWS = 200;

/** A table of the contacts of an increment whose rows can be chosen. */
export class Ledger {
   /** columns: name and unit of each column; onChoose: called with the number of a contact. */
   constructor(root, columns, onChoose) {
      this.table = root.querySelector(".litz-contacts");
      this.note = root.querySelector(".litz-contacts-note");
      this.row = root.querySelector(".litz-ledger");
      this.units = Object.fromEntries(columns.map(({ name, unit }) => [name, unit]));
      this.units.penetration = this.units.gap;
      this.onChoose = onChoose;
      this.order = "force";
      this.chosen = null;
      this.contacts = {};
   }

   /** Show the contacts of an increment: arrays by column. */
   show(contacts) {
      this.contacts = {
         ...contacts,
         penetration: contacts.gap.map((gap) => Math.max(0, -gap)),
         elements: contacts.element_1.map((first, k) => `${first}, ${contacts.element_2[k]}`),
      };
      this.drawTable();
      this.drawRow();
   }

   /** Show one contact, by its number; null: none. */
   choose(id) {
      this.chosen = id;
      this.drawTable();
      this.drawRow();
      const row = this.table.querySelector("tr.chosen");
      if (row) this.table.parentElement.scrollTop = row.offsetTop - this.table.parentElement.clientHeight / 2;
   }

   drawTable() {
      const { contacts, order } = this;
      const n = contacts.id.length;
      const size = (k) => Math.abs(contacts[order][k]);
      const rising = order === "id" ? -1 : 1;
      const rows = Array.from({ length: n }, (_, k) => k).sort((a, b) => rising * (size(b) - size(a)));
      const scales = Object.fromEntries(SHOWN.map((name) => {
         if (WORDS.includes(name)) return [name, [1, ""]];
         const largest = contacts[name].reduce((a, b) => Math.max(a, Math.abs(b)), 0);
         return [name, engineering(largest, this.units[name])];
      }));
      const head = document.createElement("tr");
      head.append(...SHOWN.map((name) => this.headCell(name, scales[name][1])));
      const shown = rows.slice(0, MOST_ROWS);
      const chosen = contacts.id.indexOf(this.chosen);
      if (chosen >= 0 && !shown.includes(chosen)) shown.push(chosen);
      this.table.replaceChildren(head, ...shown.map((k) => this.bodyRow(k, scales)));
      this.note.textContent = n === 0 ? "No wires touch at this increment."
         : n > MOST_ROWS ? `The first ${MOST_ROWS} of ${n} contacts; click a heading to sort.` : "";
   }

   headCell(name, unit) {
      const cell = document.createElement("th");
      cell.textContent = (name === "id" ? "no." : name) + (unit ? ` [${unit}]` : "");
      if (name === "elements") return cell;
      cell.classList.toggle("sorted", name === this.order);
      cell.title = "sort";
      cell.addEventListener("click", () => {
         this.order = name;
         this.drawTable();
      });
      return cell;
   }

   bodyRow(k, scales) {
      const row = document.createElement("tr");
      const id = this.contacts.id[k];
      row.dataset.id = id;
      row.classList.toggle("chosen", id === this.chosen);
      row.append(...SHOWN.map((name) => {
         const cell = document.createElement("td");
         cell.textContent = WORDS.includes(name) ? this.contacts[name][k]
            : Number((scales[name][0] * this.contacts[name][k]).toPrecision(4));
         return cell;
      }));
      row.addEventListener("click", () => this.onChoose(id));
      return row;
   }

   drawRow() {
      const k = this.chosen === null ? -1 : this.contacts.id.indexOf(this.chosen);
      const entries = [];
      if (k >= 0)
         for (const [name, unit] of Object.entries(this.units)) {
            const term = document.createElement("dt");
            term.textContent = name.replaceAll("_", " ");
            const value = document.createElement("dd");
            value.dataset.name = name;
            value.textContent = quantity(this.contacts[name][k], unit);
            entries.push(term, value);
         }
      else {
         const hint = document.createElement("p");
         hint.textContent = this.chosen === null ? "Click a spot in the picture, or a row of the table."
            : `Contact ${this.chosen} is open at this increment.`;
         entries.push(hint);
      }
      this.row.replaceChildren(...entries);
   }
}
