/* What the example needs of the machine: a way to print (semihosting), a counter, and its stack. */
#ifndef MACHINE_H
#define MACHINE_H

#include <stddef.h>
#include <stdint.h>

/* name = number, in hexadecimal */
void print_number(const char *name, uint32_t number);
void print_bytes(const char *name, const unsigned char *bytes, uint32_t count);

/* A counter, and how far it has come since. */
uint32_t ticks(void);
uint32_t ticks_since(uint32_t before);

/* What the counter says of a loop of 300000 instructions. */
uint32_t ticks_of_loop(void);

/* Fills what is free below the stack; later, the bytes of it that were used. */
void paint_stack(void);
uint32_t painted_stack(void);

#endif
