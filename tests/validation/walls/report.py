def publish(values, out): return out
