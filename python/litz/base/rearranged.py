"""Which decks the program cannot read as they are: those that place parts or generate nodes."""

import re

#: Keyword lines of such decks
REARRANGED = re.compile(
    rb"^[ \t]*\*[ \t]*(part|ngen|nfill|ncopy|elgen|elcopy|system)\b|^[ \t]*\*[ \t]*node[ \t]*,.*\bsystem[ \t]*=",
    re.MULTILINE | re.IGNORECASE,
)
#: Those that name other files
INCLUDED = re.compile(rb"^[ \t]*\*[ \t]*include[ \t]*,[ \t]*input[ \t]*=([^,\r\n]+)", re.MULTILINE | re.IGNORECASE)
