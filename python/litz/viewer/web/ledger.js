/** The contacts as a table, and all ledger values of the selected one. */

import { engineering, quantity } from "litz/data.js";

const COLUMNS = ["id", "elements", "force", "current", "penetration"];
const TEXT_COLUMNS = ["id", "elements"];
const MAX_ROWS = 200;

/** A table of the contacts of an increment whose rows can be selected. */
export class Ledger {
   /**
    * columns, surfaceColumns: name and unit of each column of contacts between wires, and with rigid surfaces;
    * onSelect: called with the number of a contact, or the text that a contact with a surface has in its place.
    */
   constructor(root, columns, surfaceColumns, onSelect) {
      this.table = root.querySelector(".litz-contacts");
      this.note = root.querySelector(".litz-contacts-note");
      this.row = root.querySelector(".litz-ledger");
      [this.units, this.surfaceUnits] = [columns, surfaceColumns].map((list) => {
         const units = Object.fromEntries(list.map(({ name, unit }) => [name, unit]));
         return { ...units, penetration: units.gap };
      });
      this.onSelect = onSelect;
      this.order = "force";
      this.selected = null;
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

   /** Select a contact by its number; null: none. */
   select(id) {
      this.selected = id;
      this.drawTable();
      this.drawRow();
      const row = this.table.querySelector("tr.selected");
      if (row) this.table.parentElement.scrollTop = row.offsetTop - this.table.parentElement.clientHeight / 2;
   }

   drawTable() {
      const { contacts, order } = this;
      const n = contacts.id.length;
      const size = order === "id" ? (k) => -placeOf(contacts.id[k], k, n) : (k) => Math.abs(contacts[order][k]);
      const rows = Array.from({ length: n }, (_, k) => k).sort((a, b) => size(b) - size(a));
      const scales = Object.fromEntries(COLUMNS.map((name) => {
         if (TEXT_COLUMNS.includes(name)) return [name, [1, ""]];
         const largest = contacts[name].reduce((a, b) => Math.max(a, Math.abs(b)), 0);
         return [name, engineering(largest, this.units[name])];
      }));
      const head = document.createElement("tr");
      head.append(...COLUMNS.map((name) => this.headCell(name, scales[name][1])));
      const shown = rows.slice(0, MAX_ROWS);
      const selected = contacts.id.indexOf(this.selected);
      if (selected >= 0 && !shown.includes(selected)) shown.push(selected);
      this.table.replaceChildren(head, ...shown.map((k) => this.bodyRow(k, scales)));
      this.note.textContent = n === 0 ? "No wires touch at this increment."
         : n > MAX_ROWS ? `The first ${MAX_ROWS} of ${n} contacts; click a heading to sort.` : "";
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
      row.classList.toggle("selected", id === this.selected);
      row.append(...COLUMNS.map((name) => {
         const cell = document.createElement("td");
         // the elements of a contact with a surface are its number
         cell.textContent = name === "id" && isOnSurface(id) ? "–" : TEXT_COLUMNS.includes(name) ? this.contacts[name][k]
            : Number((scales[name][0] * this.contacts[name][k]).toPrecision(4));
         return cell;
      }));
      row.addEventListener("click", () => this.onSelect(id));
      return row;
   }

   drawRow() {
      const k = this.selected === null ? -1 : this.contacts.id.indexOf(this.selected);
      const entries = [];
      if (k >= 0)
         for (const [name, unit] of Object.entries(isOnSurface(this.selected) ? this.surfaceUnits : this.units)) {
            const term = document.createElement("dt");
            term.textContent = name.replaceAll("_", " ");
            const value = document.createElement("dd");
            value.dataset.name = name;
            value.textContent = quantity(this.contacts[name][k], unit);
            entries.push(term, value);
         }
      else {
         const hint = document.createElement("p");
         hint.textContent = this.selected === null ? "Click a spot in the picture or a row of the table."
            : `Contact ${this.selected} is open at this increment.`;
         entries.push(hint);
      }
      this.row.replaceChildren(...entries);
   }
}

/** A contact with a rigid surface has a text in place of a number. */
function isOnSurface(id) {
   return typeof id === "string";
}

/** Place of row k of n in the order of the numbers: contacts with surfaces come last. */
function placeOf(id, k, n) {
   return isOnSurface(id) ? Number.MAX_SAFE_INTEGER - n + k : id;
}
