"""A terminal, as far as it matters which text ends up where: lines, a scrolling region, a cursor that is saved."""

import re

TOKENS = re.compile(r"\x1b\[([0-9;]*)([A-Za-z])|\x1b([78])|\x1b\].*?\x07|([\r\n])|([^\x1b\r\n]+)", re.S)


class Screen:
    """What `feed` was given, on `rows` rows of `columns`; what scrolls out at the top is in `history`."""

    def __init__(self, rows, columns):
        self.rows, self.columns = rows, columns
        self.cells = [[" "] * columns for _ in range(rows)]
        self.history = []
        self.row = self.column = 0
        self.saved = (0, 0)
        self.region = (0, rows - 1)

    def feed(self, text):
        position = 0
        while position < len(text):
            token = TOKENS.match(text, position)
            if not token:
                raise AssertionError("not known to this terminal: %r" % text[position:position + 20])
            position = token.end()
            parameters, command, cursor, control, printed = token.groups()
            if command:
                self._command(command, [int(word or 0) for word in parameters.split(";")])
            elif cursor == "7":
                self.saved = (self.row, self.column)
            elif cursor == "8":
                self.row, self.column = self.saved
            elif control == "\r":
                self.column = 0
            elif control == "\n":
                self._feed_line()
                self.column = 0  # as a pty's ONLCR has it
            elif printed:
                for letter in printed:
                    self._print(letter)

    def feet(self, text):
        """Feeds `text`; what the lowest row showed meanwhile, each change once."""
        shown = []
        for part in text.split("\x1b8"):
            self.feed(part + "\x1b8")
            if not shown or self.foot() != shown[-1]:
                shown.append(self.foot())
        return shown

    def _command(self, command, numbers):
        first = numbers[0]
        if command == "r":
            last = numbers[1] if len(numbers) > 1 else self.rows
            self.region = (max(first, 1) - 1, last - 1)
            self.row = self.column = 0
        elif command == "H":
            self.row, self.column = first - 1, numbers[1] - 1
        elif command == "K" and first == 2:
            self.cells[self.row] = [" "] * self.columns
        elif command == "A":
            self.row -= min(first, self.row)
        elif command != "m":
            raise AssertionError("not known to this terminal: %s %s" % (command, numbers))

    def _feed_line(self):
        first, last = self.region
        if self.row == last:
            self.history.append("".join(self.cells[first]).rstrip())
            del self.cells[first]
            self.cells.insert(last, [" "] * self.columns)
        elif self.row < self.rows - 1:
            self.row += 1

    def _print(self, letter):
        if self.column == self.columns:
            self._feed_line()
            self.column = 0
        self.cells[self.row][self.column] = letter
        self.column += 1

    def lines(self):
        return ["".join(row).rstrip() for row in self.cells]

    def foot(self):
        return self.lines()[-1]

    def above(self):
        """All that scrolled, in order."""
        return self.history + self.lines()[:-1]
