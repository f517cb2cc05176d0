/* How much memory the machine has, for saying beforehand what cannot be done. */
#ifndef AUR_CORE_MEMORY_H
#define AUR_CORE_MEMORY_H

/* Bytes; half of the address space where the system does not tell. */
double aur_machine_memory(void);

#endif
