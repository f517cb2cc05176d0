/* How much memory the machine has, for saying beforehand what cannot be done. */
#pragma once

/* Bytes; half of the address space where the system does not tell. */
double aur_machine_memory(void);
