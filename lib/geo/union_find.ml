let rec root parents i =
  if parents.(i) = i then i
  else begin
    parents.(i) <- parents.(parents.(i));
    root parents parents.(i)
  end
