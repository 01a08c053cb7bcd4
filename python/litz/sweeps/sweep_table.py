"""The table of a sweep: a row for each run, and means over some of its parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..base.names import unknown_name
from ..base.table import Table

#: Columns besides parameters and values
STATUS, WARNINGS, MESSAGE, DIRECTORY = "status", "warnings", "message", "directory"
OWN_COLUMNS = (STATUS, WARNINGS, MESSAGE, DIRECTORY)


class SweepTable(Table):
    """The runs of a sweep.

    Attributes
    ----------
    parameters : tuple of str
        The columns that are parameters.
    """

    def __init__(self, columns: Mapping[str, np.ndarray], units: Mapping[str, str], parameters: Sequence[str]):
        super().__init__(columns, units)
        self.parameters = tuple(parameters)

    def where(self, mask: np.ndarray) -> SweepTable:
        """The runs for which `mask` (n_rows) is true, or those it names by index."""
        return SweepTable({name: values[mask] for name, values in self.items()}, self.units, self.parameters)

    def over(self, *names: str) -> Table:
        """Means of all values over some parameters, such as the seed, with their spread; failed runs are left out.

        Parameters
        ----------
        *names : str
            Parameters.

        Returns
        -------
        Table
            A row for each combination of the other parameters: these, `runs` (the number of finished ones; `finished runs` where
            the sweep has a column `runs`), and of each value its mean, under its own name, and its standard deviation, as
            `NAME std`; nan of less than two runs.

        Examples
        --------
        >>> from litz import sweep
        >>> table = sweep(lambda side, seed: {"area": side**2 + seed}, {"side": [1.0, 2.0], "seed": [0, 1]},
        ...               directory=None, progress=False)
        >>> table.over("seed")["area"].tolist()
        [1.5, 4.5]
        """
        for name in names:
            if name not in self.parameters:
                raise ValueError(unknown_name("parameter", name, self.parameters))
        if not names:
            raise ValueError("over needs the name of at least one parameter")
        kept = [name for name in self.parameters if name not in names]
        keys = list(zip(*(self[name].tolist() for name in kept), strict=True)) if kept else [()] * self.n_rows
        groups = list(dict.fromkeys(keys))
        number = {key: row for row, key in enumerate(groups)}
        of_row = np.array([number[key] for key in keys])
        finished = self[STATUS] == "finished"
        first = [keys.index(key) for key in groups]
        columns = {name: self[name][first] for name in kept}
        columns["finished runs" if "runs" in self else "runs"] = np.bincount(of_row[finished], minlength=len(groups))
        units = {name: self.units.get(name, "") for name in columns}
        for name in (name for name in self if name not in (*self.parameters, *OWN_COLUMNS)):
            values = [self[name][finished & (of_row == row)] for row in range(len(groups))]
            with np.errstate(invalid="ignore"):
                columns[name] = np.array([one.mean() if len(one) else np.nan for one in values])
                columns[f"{name} std"] = np.array([one.std(ddof=1) if len(one) > 1 else np.nan for one in values])
            if f"{name} std" in self:
                raise ValueError(
                    f"the table has a column {name} std: there is no name for the standard deviation of {name}"
                )
            units |= dict.fromkeys((name, f"{name} std"), self.units.get(name, ""))
        return Table(columns, units)
