let words = 1024 * 1024
let make_room () = Gc.set { (Gc.get ()) with minor_heap_size = words }

let most_fillings = 50

let make_room_later () =
  let rec alarm = lazy (Gc.create_alarm look)
  and look () =
    if (Gc.quick_stat ()).minor_collections > most_fillings then begin
      Gc.delete_alarm (Lazy.force alarm);
      make_room ()
    end
  in
  ignore (Lazy.force alarm : Gc.alarm)
