/* What the process may do from here on: read and write its socket, and take memory. */
#pragma once

/* Ends with the process `parent`. No file can be opened or grow, and no process or connection made. */
void confine_self(long parent);
