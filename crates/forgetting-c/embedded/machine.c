/* Start, semihosting, counter and stack of the machines that QEMU knows. */
#include "machine.h"

int main(void);

extern uint32_t stack_top[], stack_bottom[];

#define CALL_WRITE0 4u
#define CALL_EXIT 0x18u
#define STOPPED 0x20026u
#define FAILED 0x20023u

static uint32_t semihost(uint32_t call, uintptr_t argument) {
#ifdef __riscv
    register uint32_t a0 __asm__("a0") = call;
    register uintptr_t a1 __asm__("a1") = argument;
    /* three instructions of four bytes in one page: the debugger knows the call by its neighbours */
    __asm__ volatile(".option push\n.option norvc\n.balign 16\nslli x0, x0, 0x1f\nebreak\n"
                     "srai x0, x0, 7\n.option pop"
                     : "+r"(a0)
                     : "r"(a1)
                     : "memory");
    return a0;
#else
    register uint32_t r0 __asm__("r0") = call;
    register uintptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
#endif
}

static void print(const char *text) { semihost(CALL_WRITE0, (uintptr_t)text); }

static void print_hexadecimal(uint32_t number, int digits) {
    char text[9];
    for (int i = 0; i < digits; ++i) text[i] = "0123456789abcdef"[number >> 4 * (digits - 1 - i) & 15];
    text[digits] = 0;
    print(text);
}

void print_number(const char *name, uint32_t number) {
    print(name);
    print(" ");
    print_hexadecimal(number, 8);
    print("\n");
}

void print_bytes(const char *name, const unsigned char *bytes, uint32_t count) {
    print(name);
    print(" ");
    for (uint32_t i = 0; i < count; ++i) print_hexadecimal(bytes[i], 2);
    print("\n");
}

#ifdef __riscv
/* instructions */
static void start_counter(void) {}

uint32_t ticks(void) {
    uint32_t count;
    __asm__ volatile("csrr %0, instret" : "=r"(count));
    return count;
}

uint32_t ticks_since(uint32_t before) { return ticks() - before; }
#else
/* SysTick counts down from 2^24 - 1 at the clock of the processor */
#define SYSTICK ((volatile uint32_t *)0xE000E010)

static void start_counter(void) {
    SYSTICK[1] = 0xFFFFFF;
    SYSTICK[2] = 0;
    SYSTICK[0] = 5;
}

uint32_t ticks(void) { return SYSTICK[2]; }

uint32_t ticks_since(uint32_t before) { return (before - ticks()) & 0xFFFFFF; }
#endif

uint32_t ticks_of_loop(void) {
    uint32_t before = ticks(), left = 100000;
#ifdef __riscv
    __asm__ volatile("1: addi %0, %0, -1\nnop\nbnez %0, 1b" : "+r"(left));
#else
    __asm__ volatile(".syntax unified\n1: nop\nsubs %0, #1\nbne 1b" : "+l"(left) : : "cc");
#endif
    return ticks_since(before);
}

#define PAINT 0xC5C5C5C5u

static uint32_t *painted_from;

static uint32_t *stack_pointer(void) {
    uint32_t *pointer;
#ifdef __riscv
    __asm__ volatile("mv %0, sp" : "=r"(pointer));
#else
    __asm__ volatile("mov %0, sp" : "=r"(pointer));
#endif
    return pointer;
}

__attribute__((noinline)) void paint_stack(void) {
    painted_from = stack_pointer();
    for (uint32_t *word = stack_bottom; word < painted_from; ++word) *word = PAINT;
}

__attribute__((noinline)) uint32_t painted_stack(void) {
    uint32_t *word = stack_bottom;
    while (word < painted_from && *word == PAINT) ++word;
    return (uint32_t)(painted_from - word) * sizeof *word;
}

void *memcpy(void *to, const void *from, size_t count) {
    unsigned char *target = to;
    const unsigned char *source = from;
    while (count--) *target++ = *source++;
    return to;
}

void *memset(void *to, int value, size_t count) {
    unsigned char *target = to;
    while (count--) *target++ = (unsigned char)value;
    return to;
}

void start(void) {
#if defined(__ARM_FP) && __ARM_FP
    *(volatile uint32_t *)0xE000ED88 |= 0xF << 20;
    __asm__ volatile("dsb\nisb");
#endif
    start_counter();
    semihost(CALL_EXIT, main() ? FAILED : STOPPED);
    for (;;) {
    }
}

#ifdef __riscv
__attribute__((naked, section(".start"))) void _start(void) {
    __asm__ volatile("la sp, stack_top\nj start");
}
#else
__attribute__((section(".start"), used)) static const void *const vectors[] = {stack_top, (void *)start};
#endif
