let forbidden = max_int / 4

let add a b = if a >= forbidden || b >= forbidden then forbidden else a + b

type t = {
  column_of : int array;
  row_of : int array;  (* by column, -1 for none *)
  dual : int array;  (* by column: not positive, 0 for columns without row *)
}

(* Each row that has one takes a free column among its cheapest: so dear searches start from few rows only. *)
let take_cheapest ~rows ~columns cost column_of row_of =
  for row = 0 to rows - 1 do
    let base = row * columns in
    let least = ref forbidden and choice = ref (-1) in
    for column = 0 to columns - 1 do
      let c = cost.(base + column) in
      if c < !least then begin
        least := c;
        choice := if row_of.(column) < 0 then column else -1
      end
      else if c = !least && !choice < 0 && c < forbidden && row_of.(column) < 0 then choice := column
    done;
    if !choice >= 0 then begin
      column_of.(row) <- !choice;
      row_of.(!choice) <- row
    end
  done

(* Shortest augmenting paths, after Jonker and Volgenant (1987).

   One search runs Dijkstra's algorithm over the columns. [order] holds first the columns that are done, up to
   [low], then those at distance [least] that are not, up to [high], then the others. *)
let solve ~spent ~rows ~columns cost =
  let column_of = Array.make rows (-1) and row_of = Array.make columns (-1) in
  let dual = Array.make columns 0 in
  take_cheapest ~rows ~columns cost column_of row_of;
  spent := !spent + (rows * columns);
  let distance = Array.make columns 0 and previous = Array.make columns 0 in
  let order = Array.init columns Fun.id in
  let swap a b =
    let column = order.(a) in
    order.(a) <- order.(b);
    order.(b) <- column
  in
  let search start =
    for column = 0 to columns - 1 do
      let c = cost.((start * columns) + column) in
      distance.(column) <- (if c < forbidden then c - dual.(column) else max_int);
      previous.(column) <- start
    done;
    let low = ref 0 and high = ref 0 and least = ref 0 in
    let settled = ref 0 (* the columns that were done before [least] rose *) in
    let target = ref (-1) and stuck = ref (columns = 0) in
    while !target < 0 && not !stuck do
      if !low = !high then begin
        settled := !low;
        least := max_int;
        for place = !low to columns - 1 do
          let d = distance.(order.(place)) in
          if d < !least then begin
            high := !low;
            least := d
          end;
          if d = !least && d < max_int then begin
            swap place !high;
            incr high
          end
        done;
        spent := !spent + (columns - !low);
        if !low = !high then stuck := true
        else
          for place = !low to !high - 1 do
            if !target < 0 && row_of.(order.(place)) < 0 then target := order.(place)
          done
      end;
      if !target < 0 && not !stuck then begin
        let column = order.(!low) in
        incr low;
        let row = row_of.(column) in
        let base = row * columns in
        let saved = cost.(base + column) - dual.(column) - !least in
        let place = ref !high in
        spent := !spent + (columns - !high);
        while !target < 0 && !place < columns do
          let column = order.(!place) in
          let c = cost.(base + column) in
          if c < forbidden then begin
            let d = c - dual.(column) - saved in
            if d < distance.(column) then begin
              distance.(column) <- d;
              previous.(column) <- row;
              if d = !least then
                if row_of.(column) < 0 then target := column
                else begin
                  swap !place !high;
                  incr high
                end
            end
          end;
          incr place
        done
      end
    done;
    if !stuck then begin
      let scanned = List.init !low (fun place -> row_of.(order.(place))) in
      Error (List.sort Int.compare (start :: scanned))
    end
    else begin
      for place = 0 to !settled - 1 do
        let column = order.(place) in
        dual.(column) <- dual.(column) + distance.(column) - !least
      done;
      let rec augment column =
        let row = previous.(column) in
        let released = column_of.(row) in
        row_of.(column) <- row;
        column_of.(row) <- column;
        if row <> start then augment released
      in
      augment !target;
      Ok ()
    end
  in
  let rec search_all row =
    if row = rows then Ok { column_of; row_of; dual }
    else if column_of.(row) >= 0 then search_all (row + 1)
    else match search row with Ok () -> search_all (row + 1) | Error _ as error -> error
  in
  search_all 0

(* The matchings that cost as little as the one given are those of all rows that use tight pairs only, of reduced
   cost 0, and every column whose dual is below 0. To see them as perfect matchings, one more row, [spare], holds all
   columns that are free, and may hold any whose dual is 0. Row by row, a lower column is taken if, along tight
   pairs between later rows, its holder can in the end be given the column that the row gave up. *)
let in_pick_order ~rows ~columns cost { column_of; row_of; dual } =
  let spare = rows in
  let column_of = Array.copy column_of in
  let holder = Array.map (fun row -> if row < 0 then spare else row) row_of in
  let is_tight row column =
    if row = spare then dual.(column) = 0
    else
      let own = column_of.(row) in
      let base = row * columns in
      let c = cost.(base + column) in
      c < forbidden && c - dual.(column) = cost.(base + own) - dual.(own)
  in
  let tight row =
    let rec list column found =
      if column < 0 then Array.of_list found
      else list (column - 1) (if is_tight row column then column :: found else found)
    in
    list (columns - 1) []
  in
  let tight = Array.init (rows + 1) tight in
  let may_hold = Array.init (rows + 1) (fun row ->
      let set = Bytes.make columns '\000' in
      Array.iter (fun column -> Bytes.set set column '\001') tight.(row);
      set)
  in
  let visited = Array.make (rows + 1) (-1) (* for the sake of which row, last *) in
  let gives_up = Array.make (rows + 1) 0 and gives_to = Array.make (rows + 1) 0 in
  let queue = Queue.create () in
  let visit row ~taker column =
    let next = holder.(column) in
    if next > row && visited.(next) <> row then begin
      visited.(next) <- row;
      gives_up.(next) <- column;
      gives_to.(next) <- taker;
      Queue.add next queue
    end
  in
  (* Who can take the column [wanted], among those that can be reached by giving up columns; breadth first. *)
  let rec last_taker row wanted =
    match Queue.take_opt queue with
    | None -> None
    | Some taker when Bytes.get may_hold.(taker) wanted = '\001' -> Some taker
    | Some taker ->
      Array.iter (visit row ~taker) tight.(taker);
      last_taker row wanted
  in
  let rec hand_over row taker column =
    holder.(column) <- taker;
    if taker <> spare then column_of.(taker) <- column;
    if taker <> row then hand_over row gives_to.(taker) gives_up.(taker)
  in
  for row = 0 to rows - 1 do
    let wanted = column_of.(row) in
    let rec lower place =
      let column = tight.(row).(place) in
      if column < wanted then begin
        Queue.clear queue;
        visit row ~taker:row column;
        match last_taker row wanted with
        | Some taker -> hand_over row taker wanted
        | None -> lower (place + 1)
      end
    in
    lower 0
  done;
  column_of
