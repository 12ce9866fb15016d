let enlarge () = Gc.set { (Gc.get ()) with minor_heap_size = 1024 * 1024 }
