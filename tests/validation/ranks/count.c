// SPDX-License-Identifier: GPL-2.0-or-later
// Counts what each rank sends, for LD_PRELOAD (MPI's profiling interface). At the end ranks add a line to the file that the
// environment names in MPI_COUNTS: messages, bytes in them, reductions, bytes of each rank in them.
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

static long messages, sent, reductions, reduced;

static long bytes(int count, MPI_Datatype type)
{
  int size;
  PMPI_Type_size(type, &size);
  return (long) count * size;
}

int MPI_Send(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  messages++;
  sent += bytes(count, type);
  return PMPI_Send(data, count, type, to, tag, comm);
}

int MPI_Isend(const void *data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request *request)
{
  messages++;
  sent += bytes(count, type);
  return PMPI_Isend(data, count, type, to, tag, comm, request);
}

int MPI_Sendrecv(const void *data, int count, MPI_Datatype type, int to, int tag, void *received, int most,
                 MPI_Datatype of, int from, int other_tag, MPI_Comm comm, MPI_Status *status)
{
  messages++;
  sent += bytes(count, type);
  return PMPI_Sendrecv(data, count, type, to, tag, received, most, of, from, other_tag, comm, status);
}

int MPI_Allreduce(const void *data, void *result, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  reductions++;
  reduced += bytes(count, type);
  return PMPI_Allreduce(data, result, count, type, op, comm);
}

int MPI_Reduce(const void *data, void *result, int count, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm)
{
  reductions++;
  reduced += bytes(count, type);
  return PMPI_Reduce(data, result, count, type, op, root, comm);
}

int MPI_Bcast(void *data, int count, MPI_Datatype type, int root, MPI_Comm comm)
{
  reductions++;
  reduced += bytes(count, type);
  return PMPI_Bcast(data, count, type, root, comm);
}

int MPI_Finalize(void)
{
  const char *name = getenv("MPI_COUNTS");
  FILE *file = name ? fopen(name, "a") : NULL;
  if (file) { // one short line: not mixed with those of other ranks
    fprintf(file, "%ld %ld %ld %ld\n", messages, sent, reductions, reduced);
    fclose(file);
  }
  return PMPI_Finalize();
}
