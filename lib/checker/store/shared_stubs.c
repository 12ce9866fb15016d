/* Memory that processes share after a fork, and the atomic operations on its words that the store needs. */
#define _GNU_SOURCE
#include <sched.h>
#include <stdint.h>
#include <sys/mman.h>
#include <unistd.h>
#include <caml/alloc.h>
#include <caml/bigarray.h>
#include <caml/fail.h>
#include <caml/memory.h>
#include <caml/mlvalues.h>

#ifndef MAP_NORESERVE
#define MAP_NORESERVE 0
#endif

static size_t element_size(int kind) {
  switch (kind & CAML_BA_KIND_MASK) {
    case CAML_BA_UINT8: return 1;
    case CAML_BA_INT32: return 4;
    default: return sizeof(intnat);
  }
}

/* As many elements of a kind, all 0; they take memory once they are written to. */
value dolphin_shared_map(value kind, value length) {
  intnat n = Long_val(length);
  int flags = Int_val(kind);
  void *at = mmap(NULL, (size_t)n * element_size(flags), PROT_READ | PROT_WRITE,
                  MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (at == MAP_FAILED) caml_raise_out_of_memory();
  return caml_ba_alloc_dims(flags | CAML_BA_C_LAYOUT | CAML_BA_EXTERNAL, 1, at, n);
}

/* Memory of the elements from the [from]th on, as many as [length], is given back: those of whole pages are 0 again. */
value dolphin_shared_forget(value array, value from, value length) {
  struct caml_ba_array *a = Caml_ba_array_val(array);
  uintptr_t size = element_size(a->flags), page = (uintptr_t)sysconf(_SC_PAGESIZE);
  uintptr_t first = ((uintptr_t)a->data + (uintptr_t)Long_val(from) * size + page - 1) / page * page;
  uintptr_t last = ((uintptr_t)a->data + (uintptr_t)(Long_val(from) + Long_val(length)) * size) / page * page;
#ifdef MADV_REMOVE
  if (first < last) madvise((void *)first, last - first, MADV_REMOVE);
#else
  (void)first, (void)last;
#endif
  return Val_unit;
}

value dolphin_shared_unmap(value array) {
  struct caml_ba_array *a = Caml_ba_array_val(array);
  munmap(a->data, (size_t)a->dim[0] * element_size(a->flags));
  a->data = NULL;
  a->dim[0] = 0;
  return Val_unit;
}

#define WORD(array, i) ((intnat *)Caml_ba_data_val(array) + (i))

intnat dolphin_shared_read(value array, intnat i) { return __atomic_load_n(WORD(array, i), __ATOMIC_ACQUIRE); }
value dolphin_shared_read_bytecode(value array, value i) { return Val_long(dolphin_shared_read(array, Long_val(i))); }

value dolphin_shared_write(value array, intnat i, intnat x) {
  __atomic_store_n(WORD(array, i), x, __ATOMIC_RELEASE);
  return Val_unit;
}
value dolphin_shared_write_bytecode(value array, value i, value x) {
  return dolphin_shared_write(array, Long_val(i), Long_val(x));
}

intnat dolphin_shared_add(value array, intnat i, intnat n) {
  return __atomic_fetch_add(WORD(array, i), n, __ATOMIC_ACQ_REL);
}
value dolphin_shared_add_bytecode(value array, value i, value n) {
  return Val_long(dolphin_shared_add(array, Long_val(i), Long_val(n)));
}

intnat dolphin_shared_swap(value array, intnat i, intnat before, intnat after) {
  return __atomic_compare_exchange_n(WORD(array, i), &before, after, 0, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE);
}
value dolphin_shared_swap_bytecode(value array, value i, value before, value after) {
  return Val_long(dolphin_shared_swap(array, Long_val(i), Long_val(before), Long_val(after)));
}

/* Bytes of memory of the machine. */
value dolphin_machine_memory(value unit) {
  (void)unit;
  return Val_long((intnat)sysconf(_SC_PHYS_PAGES) * (intnat)sysconf(_SC_PAGESIZE));
}

/* Those that this process may use. */
value dolphin_machine_cores(value unit) {
  (void)unit;
#ifdef __linux__
  cpu_set_t cores;
  if (sched_getaffinity(0, sizeof cores, &cores) == 0) return Val_long(CPU_COUNT(&cores));
#endif
  return Val_long((intnat)sysconf(_SC_NPROCESSORS_ONLN));
}
